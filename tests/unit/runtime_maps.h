/// Maps baked in memory and opened by the runtime, for its tests.
#ifndef SL_RUNTIME_MAPS_H
#define SL_RUNTIME_MAPS_H

#include "testing.h"

#include "bake/slv.h"
#include "runtime/sightline_runtime.h"
#include "sightline/import.h"
#include "sightline/solvers.h"

#include <glob.h>
#include <unistd.h>

typedef struct baked_file {
    const char *name;
    sl_baked baked;
    char *bytes;
    size_t size;
    sl_runtime runtime;
} baked_file;

static inline void baked_file_open(baked_file *f) {
    const sl_runtime_status status = sl_runtime_open(f->bytes, f->size, &f->runtime);
    if (status != SL_RUNTIME_OK) fail_msg("%s: %s", f->name, sl_runtime_status_text(status));
}

/// The map of `f->baked` cut, seen, printed, opened.
static inline void baked_file_make(sl_context *context, baked_file *f, bool inside_only) {
    sl_baked *b = &f->baked;
    const sl_subdivide_options rules = sl_subdivide_options_default();
    assert_ok(context, sl_map_clean(context, &b->map, NULL));
    assert_ok(context, sl_subdivide_kd(context, &b->map, &rules, &b->space));
    sl_see_options options = sl_see_options_default();
    options.solver = sl_funnel();
    options.inside_only = inside_only;
    size_t count;
    assert_ok(context, sl_see_methods(&count)->see(context, &b->space, &options, &b->visibility));
    FILE *stream = open_memstream(&f->bytes, &f->size);
    assert_non_null(stream);
    assert_ok(context, sl_slv_print(context, b, stream));
    assert_int_equal(fclose(stream), 0);
    baked_file_open(f);
}

static inline baked_file baked_file_of_text(sl_context *context, const char *statements) {
    baked_file f = {.name = "text", .baked = {.method = "dfs", .solver = "funnel"}};
    char text[1024];
    snprintf(text, sizeof text, "sightline 1\n%s", statements);
    assert_ok(context, sl_map_read_text(context, "text", text, strlen(text), &f.baked.map));
    baked_file_make(context, &f, false);
    return f;
}

static inline baked_file baked_file_of(sl_context *context, const char *path,
                                       const sl_import_options *options) {
    baked_file f = {.name = path, .baked = {.method = "dfs", .solver = "funnel"}};
    assert_ok(context, sl_map_read(context, path, options, &f.baked.map));
    baked_file_make(context, &f, false);
    return f;
}

static inline void baked_file_destroy(sl_context *context, baked_file *f) {
    sl_baked_destroy(context, &f->baked);
    free(f->bytes);
}

/// Does something with every map of the project, the hard ones too, and with a floor of Soda Hall
/// where its model lies beside the project.
static inline void baked_file_each(void (*visit)(const baked_file *)) {
    static const char *const patterns[] = {"/maps/*.map", "/maps/*.txt", "/tests/cases/*.map"};
    sl_context *context = testing_context(NULL);
    glob_t found;
    for (size_t i = 0; i < sizeof patterns / sizeof *patterns; i++) {
        char pattern[1024];
        snprintf(pattern, sizeof pattern, "%s%s", SIGHTLINE_SOURCE_DIR, patterns[i]);
        assert_int_equal(glob(pattern, i ? GLOB_APPEND : 0, NULL, &found), 0);
    }
    for (size_t i = 0; i < found.gl_pathc; i++) {
        baked_file f = baked_file_of(context, found.gl_pathv[i], NULL);
        visit(&f);
        baked_file_destroy(context, &f);
    }
    globfree(&found);
    const char *const soda = SIGHTLINE_SOURCE_DIR "/../shared/data/soda-hall-floor5.ug";
    if (access(soda, R_OK) == 0) {
        sl_import_options options = sl_import_options_default();
        options.has_slice = true;
        options.slice = 1040;
        baked_file f = baked_file_of(context, soda, &options);
        visit(&f);
        baked_file_destroy(context, &f);
    }
    sl_context_destroy(context);
}

#endif
