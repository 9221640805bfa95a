#include "io/beside.h"

#include "map/scan.h"

#include <errno.h>
#include <sys/stat.h>

#define MOST_BYTES ((off_t)1 << 30)

char *sl_beside_path(sl_context *context, const char *name, const char *relative) {
    const char *slash = strrchr(name, '/');
    const size_t folder = slash && relative[0] != '/' ? (size_t)(slash + 1 - name) : 0;
    const size_t length = strlen(relative);
    char *path = sl_alloc(context, folder + length + 1);
    if (!path) return NULL;
    memcpy(path, name, folder);
    memcpy(path + folder, relative, length + 1);
    for (char *at = path + folder; *at; at++)
        if (*at == '\\') *at = '/';
    return path;
}

bool sl_beside_is_there(const char *path) {
    struct stat there;
    return stat(path, &there) == 0 && S_ISREG(there.st_mode);
}

static sl_status fail(sl_context *context, const char *name, const char *path, const char *why) {
    return sl_fail_at(context, name, 0, "it names the file %.200s: %s", path, why);
}

sl_status sl_beside_read(sl_context *context, const char *name, const char *relative, char **path,
                         sl_bytes *bytes) {
    char *from = sl_beside_path(context, name, relative);
    if (!from) return SL_NO_MEMORY;
    struct stat there;
    sl_status status = SL_OK;
    if (stat(from, &there) != 0)
        status = fail(context, name, from, strerror(errno));
    else if (!S_ISREG(there.st_mode))
        status = fail(context, name, from, "no plain file");
    else if (there.st_size > MOST_BYTES)
        status = fail(context, name, from, "larger than 2^30 bytes");
    else
        status = sl_file_read(context, from, bytes);
    if (status == SL_OK)
        *path = from;
    else
        sl_free(context, from);
    return status;
}
