/// Sums over what a result is made from.
#include "inputs/made_from.h"

#include "sightline/support.h"

#include <string.h>

uint64_t made_from_bytes(uint64_t sum, const char *bytes, size_t size) {
    for (size_t i = 0; i < size; i++) sum = (sum ^ (unsigned char)bytes[i]) * 0x100000001b3u;
    return sum * 0x100000001b3u;
}

uint64_t made_from_command(const char *name) {
    const uint64_t sum =
        made_from_bytes(0xcbf29ce484222325u, SIGHTLINE_VERSION, strlen(SIGHTLINE_VERSION));
    return made_from_bytes(sum, name, strlen(name));
}

sl_status made_from_argument(sl_context *context, const char *argument, uint64_t *sum) {
    const char *value = strncmp(argument, "--", 2) == 0 ? strchr(argument, '=') : NULL;
    const char *path = value ? value + 1 : argument;
    if (sl_path_look(path) != SL_PATH_FILE) {
        *sum = made_from_bytes(*sum, argument, strlen(argument));
        return SL_OK;
    }
    sl_bytes file;
    SL_TRY(sl_file_read(context, path, &file));
    *sum = made_from_bytes(*sum, argument, (size_t)(path - argument));
    *sum = made_from_bytes(*sum, file.data, file.size);
    sl_free(context, file.data);
    return SL_OK;
}
