/// The map files that tests go through: those of maps/ and its folders, the hard ones of
/// tests/cases, and the fifth floor of Soda Hall where its model lies beside the project.
#ifndef SL_MAP_FILES_H
#define SL_MAP_FILES_H

#include "testing.h"

#include "sightline/io.h"

#include <glob.h>

enum { MAP_FILES_OWN = 1, MAP_FILES_CASES = 2, MAP_FILES_SODA_HALL = 4, MAP_FILES_ALL = 7 };

static inline void map_files_add(const char *beside_root, bool needed, glob_t *found) {
    char pattern[4096];
    snprintf(pattern, sizeof pattern, "%s/%s", SIGHTLINE_SOURCE_DIR, beside_root);
    if (glob(pattern, GLOB_APPEND, NULL, found) == 0) return;
    if (needed) fail_msg("there is no %s", pattern);
    print_message("skipped: %s is not there\n", pattern);
}

/// The paths of all files of the kinds that `which` adds up; globfree() is the caller's.
static inline glob_t map_files_find(unsigned which) {
    glob_t found = {0};
    if (which & MAP_FILES_OWN) {
        map_files_add("maps/*.map", true, &found);
        map_files_add("maps/*.txt", true, &found);
        map_files_add("maps/*/*.map", true, &found);
    }
    if (which & MAP_FILES_CASES) map_files_add("tests/cases/*.map", true, &found);
    if (which & MAP_FILES_SODA_HALL)
        map_files_add("../shared/data/soda-hall-floor5.ug", false, &found);
    return found;
}

static inline void map_files_each(unsigned which, void (*visit)(const char *path)) {
    glob_t found = map_files_find(which);
    for (size_t i = 0; i < found.gl_pathc; i++) visit(found.gl_pathv[i]);
    globfree(&found);
}

static inline void map_files_read(sl_context *context, const char *path, sl_map *map) {
    sl_import_options options = sl_import_options_default();
    options.has_slice = strstr(path, ".ug") != NULL;
    options.slice = 1040;
    assert_ok(context, sl_io_use(context));
    assert_ok(context, sl_map_read(context, path, &options, map));
}

/// Reads one of them and cuts it as it calls for.
static inline void map_files_cut(sl_context *context, const char *path, sl_map *map,
                                 sl_space *space) {
    map_files_read(context, path, map);
    testing_subdivide(context, map, space);
}

#endif
