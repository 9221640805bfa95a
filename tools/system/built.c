/// The register of parts that are linked, and the refusal by name of those that are not.
#include "system/built.h"

#include "sightline/stab.h"
#include "sightline/support.h"

#include <string.h>

static const built_part *const no_parts[] = {NULL};
static const built_part *const *parts = no_parts;

void built_register(const built_part *const *linked) {
    parts = linked;
}

// --- commands

/// SL_UNSUPPORTED, with what the build has not.
static sl_status refuse_command(sl_context *context, const char *name) {
    if (strcmp(name, "draw") == 0 || strcmp(name, "report") == 0)
        return built_need_pictures(context);
    if (strcmp(name, "reject") == 0) return built_need_io(context, NULL, &(const built_io *){NULL});
    return sl_fail(context, SL_UNSUPPORTED,
                   "this build has no command '%s' (SIGHTLINE_STUDY is off)", name);
}

sl_status built_run(command_console *console, int argc, char **argv) {
    for (size_t i = 0; parts[i]; i++)
        for (const built_command *c = parts[i]->commands; c && c->name; c++)
            if (strcmp(c->name, argv[0]) == 0) return c->run(console, argc, argv);
    return refuse_command(console->context, argv[0]);
}

// --- solvers

static sl_status refuse_solver(sl_context *context, sl_box bounds, void **state) {
    (void)bounds, (void)state;
    return sl_fail(context, SL_UNSUPPORTED, "this build has no GLPK (SIGHTLINE_GLPK is off)");
}

static void destroy_nothing(sl_context *context, void *state) {
    (void)context, (void)state;
}

#define ABSENT(NAME, GUARANTEE)                                                                    \
    {                                                                                              \
        .name = (NAME), .what = "not in this build (SIGHTLINE_GLPK is off)",                       \
        .guarantee = (GUARANTEE), .create = refuse_solver, .destroy = destroy_nothing              \
    }
static const sl_solver absent[] = {ABSENT("glpk", SL_ROUNDED), ABSENT("hybrid", SL_EXACT),
                                   ABSENT("glpk-exact", SL_EXACT)};

const sl_solver *built_solver(size_t index) {
    if (index-- == 0) return sl_funnel();
    for (size_t i = 0; parts[i]; i++)
        for (size_t k = 0; parts[i]->solvers && k <= index; k++)
            if (!parts[i]->solvers[k] || k == index)
                return parts[i]->solvers[k] ? parts[i]->solvers[k]() : NULL;
    return index < sizeof absent / sizeof *absent ? &absent[index] : NULL;
}

const sl_cover_program *built_cover_program(void) {
    for (size_t i = 0; parts[i]; i++)
        if (parts[i]->cover) return parts[i]->cover();
    return NULL;
}

// --- foreign formats

static const built_io *find_io(void) {
    for (size_t i = 0; parts[i]; i++)
        if (parts[i]->io) return parts[i]->io;
    return NULL;
}

sl_status built_need_io(sl_context *context, const char *name, const built_io **out) {
    *out = find_io();
    if (*out) return SL_OK;
    return sl_fail(context, SL_UNSUPPORTED,
                   "%s%sthis build reads and writes no foreign formats (SIGHTLINE_IO is off)",
                   name ? name : "", name ? ": " : "");
}

static sl_status refuse_map(sl_context *context, const char *name, const char *text, size_t size,
                            const sl_import_options *options, sl_map *map) {
    (void)text, (void)size, (void)options, (void)map;
    return built_need_io(context, name, &(const built_io *){NULL});
}

static sl_status refuse_list(sl_context *context, const char *name, const char *text, size_t size,
                             sl_map_list *list) {
    (void)list;
    return refuse_map(context, name, text, size, NULL, NULL);
}

static sl_status refuse_write(sl_context *context, const sl_map *map, FILE *stream) {
    (void)map, (void)stream;
    return refuse_map(context, NULL, NULL, 0, NULL, NULL);
}

static sl_status refuse_export(sl_context *context, const sl_baked *baked,
                               const sl_export_options *options, const char *path) {
    (void)baked, (void)options, (void)path;
    return refuse_map(context, NULL, NULL, 0, NULL, NULL);
}

#define WHAT "not in this build (SIGHTLINE_IO is off)"

static const sl_map_format foreign = {
    .name = "foreign",
    .endings = SL_IO_ENDINGS,
    .what = WHAT,
    .read = refuse_map,
    .takes = UINT32_MAX,
    .list = refuse_list,
    .write = refuse_write,
    .keeps = SL_KEEPS_ALL,
};

static const sl_export_format exports[] = {
    {.name = "png", .what = WHAT, .write = refuse_export},
    {.name = "reject", .what = WHAT, .takes = SL_EXPORT_TAKES_WAD, .write = refuse_export},
};

sl_status built_use_formats(sl_context *context) {
    const built_io *io = find_io();
    if (io) return io->use(context);
    SL_TRY(sl_map_formats_add(context, &foreign, 1));
    return sl_export_formats_add(context, exports, sizeof exports / sizeof *exports);
}

// --- pictures

const built_draw *built_pictures(void) {
    for (size_t i = 0; parts[i]; i++)
        if (parts[i]->draw) return parts[i]->draw;
    return NULL;
}

sl_status built_need_pictures(sl_context *context) {
    return built_pictures() ? SL_OK
                            : sl_fail(context, SL_UNSUPPORTED,
                                      "this build has no pictures (SIGHTLINE_DRAW is off)");
}

sl_draw_options built_draw_options(void) {
    return built_pictures() ? built_pictures()->options_default()
                            : (sl_draw_options){.width = SL_DRAW_WIDTH_MIN};
}
