#include "shelf.h"

#include "base/base.h"
#include "sightline/import.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum { MAPS_MOST = 200, PATH = 4096 };

/// By ending. Text files and pictures can be anything, and are listed only where they lie with
/// maps.
static bool is_map(const char *name, bool with_maps) {
    const char *dot = strrchr(name, '.');
    if (!dot) return false;
    if (strcasecmp(dot, ".slv") == 0) return true;
    const char *const vague[] = {".txt", ".png", ".svg", ".yaml", ".json", ".xml", ".pgm", ".pbm"};
    for (size_t i = 0; i < sizeof vague / sizeof *vague; i++)
        if (strcasecmp(dot, vague[i]) == 0 && (!with_maps || i > 0)) return false;
    size_t count;
    const sl_map_format *formats = sl_map_formats(&count);
    for (size_t i = 0; i < count; i++) {
        for (const char *at = formats[i].endings; *at;) {
            const size_t length = strcspn(at, " ");
            if (strlen(dot) == length && strncasecmp(dot, at, length) == 0) return true;
            for (at += length; *at == ' ';) at++;
        }
    }
    return false;
}

static int by_name(const void *a, const void *b) {
    return strcmp(*(char *const *)a, *(char *const *)b);
}

static void add_folder(sl_app *app, const char *folder, bool with_maps) {
    DIR *dir = opendir(folder);
    if (!dir) return;
    const size_t first = app->map_count;
    char path[PATH];
    for (struct dirent *entry; (entry = readdir(dir)) && app->map_count < MAPS_MOST;) {
        const int length = snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        struct stat info;
        if (length < 0 || length >= PATH || !is_map(entry->d_name, with_maps) ||
            stat(path, &info) != 0 || !S_ISREG(info.st_mode))
            continue;
        char *copy = sl_copy_text(app->context, path, (size_t)length);
        if (copy) app->maps[app->map_count++] = copy;
    }
    closedir(dir);
    qsort(app->maps + first, app->map_count - first, sizeof *app->maps, by_name);
}

static bool same_folder(const char *a, const char *b) {
    struct stat x, y;
    return stat(a, &x) == 0 && stat(b, &y) == 0 && x.st_dev == y.st_dev && x.st_ino == y.st_ino;
}

void sl_shelf_fill(sl_app *app, const char *beside) {
    app->maps = sl_alloc_array(app->context, MAPS_MOST, sizeof *app->maps);
    if (!app->maps) return;
    char folder[PATH] = ".";
    const char *slash = beside ? strrchr(beside, '/') : NULL;
    if (slash && slash - beside < PATH - 1)
        snprintf(folder, sizeof folder, "%.*s", (int)(slash - beside),
                 slash == beside ? "/" : beside);
    add_folder(app, folder, true);
    if (!same_folder(folder, "maps")) add_folder(app, "maps", true);
    if (!same_folder(folder, "maps/oblique")) add_folder(app, "maps/oblique", true);
    if (!same_folder(folder, ".")) add_folder(app, ".", false);
}
