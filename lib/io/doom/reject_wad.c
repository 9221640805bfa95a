/// New REJECTs in a copy of a WAD: of one map from its baked file, or of many maps, which are baked
/// here. Maps are baked beside each other, each by one thread, the largest first: so none is left
/// to one thread at the end.
#include "base/base.h"
#include "io/doom/wad.h"
#include "io/io_formats.h"
#include "sightline/io.h"

#include <stdlib.h>
#include <string.h>

// --- one map, from its baked file

typedef struct reject_export {
    sl_context *context;
    const sl_baked *baked;
    const sl_export_options *options;
    sli_wad wad;
    sli_wad_map map;
    sli_doom_level level;
    sli_reject reject;
} reject_export;

static bool has_walls(const sl_space *space, const sl_map *map) {
    if (map->wall_count != space->wall_count) return false;
    for (size_t i = 0; i < map->wall_count; i++) {
        const sl_wall *a = &map->walls[i], *b = &space->walls[i];
        if (a->a.x != b->a.x || a->a.y != b->a.y || a->b.x != b->b.x || a->b.y != b->b.y)
            return false;
    }
    return true;
}

/// Whether the walls of the space are those of the WAD's map, read and cleaned as a bake does.
static sl_status compare_map(const reject_export *export, bool cells, bool *same) {
    const sl_import_options options = {
        .map = export->map.name, .cells = cells, .sectors = export->baked->map.seam_count > 0};
    sl_map map = {0};
    SL_TRY(sli_map_read_wad(export->context, export->wad.name, (const char *)export->wad.bytes,
                            export->wad.size, &options, &map));
    const sl_status status = sl_map_clean(export->context, &map, NULL, NULL);
    *same = has_walls(&export->baked->space, &map);
    sl_map_destroy(export->context, &map);
    return status;
}

/// Baked with the cells of a node builder, walls are cut where these have corners.
static sl_status check_map(const reject_export *export) {
    bool same = false;
    SL_TRY(compare_map(export, false, &same));
    if (!same) {
        const sl_status status = compare_map(export, true, &same);
        if (status != SL_BAD_INPUT) SL_TRY(status); // there may be no such cells
    }
    if (same) return SL_OK;
    return sl_fail_at(export->context, export->wad.name, 0,
                      "map %s has other walls than the baked file, which was made from another map",
                      export->map.name);
}

/// A REJECT must hide nothing that is seen.
static sl_status check_baked(sl_context *context, const sl_baked *baked) {
    if (baked->visibility.guarantee == SL_AGGRESSIVE)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "a REJECT needs a method that misses nothing; this file was baked by '%s', "
                       "which may",
                       baked->method);
    if (baked->map.door_count)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "a REJECT needs doors that are seen through; bake without --doors, or "
                       "with --without door");
    return SL_OK;
}

/// Whether a line parts two sectors: if so, a bake with sectors has seams.
static bool parts_sectors(const sli_doom_level *level) {
    for (size_t i = 0; i < level->line_count; i++) {
        const sli_doom_line *line = &level->lines[i];
        if (line->right != SLI_NO_SECTOR && line->left != SLI_NO_SECTOR &&
            line->right != line->left && !line->moves)
            return true;
    }
    return false;
}

static sl_status write_reject(const reject_export *export, const char *path) {
    const sli_wad_edit edit = {
        .map = export->map, .name = "REJECT", .lump = {export->reject.bytes, export->reject.size}};
    SL_TRY(sli_wad_write(export->context, &export->wad, &edit, 1, path));
    const sl_reject_account *account = &export->reject.account;
    const double pairs = (double)account->sectors * ((double)account->sectors - 1) / 2;
    sl_note(export->context, "map %s: of %u sector%s %llu pairs (%.1f %%) are hidden",
            export->map.name, account->sectors, account->sectors == 1 ? "" : "s",
            (unsigned long long)account->hidden,
            pairs > 0 ? 100 * (double)account->hidden / pairs : 0);
    if (account->unknown)
        sl_note(export->context,
                "map %s: %u sector%s no cell that was looked from; nothing is "
                "hidden from %s",
                export->map.name, account->unknown,
                account->unknown == 1 ? " contains" : "s contain",
                account->unknown == 1 ? "it" : "them");
    if (!export->baked->map.seam_count && parts_sectors(&export->level))
        sl_note(export->context,
                "map %s: cells reach into several sectors, so that less is hidden: bake with "
                "--sectors --sight open for the table that 'sightline reject' makes",
                export->map.name);
    return SL_OK;
}

static sl_status export_map(reject_export *export, const char *path) {
    SL_TRY(sli_wad_find_map(export->context, &export->wad, export->options->map, &export->map));
    SL_TRY(check_map(export));
    SL_TRY(sli_doom_read(export->context, &export->wad, &export->map, &export->level));
    SL_TRY(sli_reject_make(export->context, &export->baked->space, &export->baked->visibility.pvs,
                           &export->level, &export->reject));
    return write_reject(export, path);
}

sl_status sli_export_reject(sl_context *context, const sl_baked *baked,
                            const sl_export_options *options, const char *path) {
    if (!options->wad || !options->map)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "a REJECT is written into a copy of its WAD: give --wad IN.wad and --map "
                       "NAME, the map that was baked");
    SL_TRY(check_baked(context, baked));
    sl_bytes bytes;
    SL_TRY(sl_file_read(context, options->wad, &bytes));
    reject_export export = {.context = context, .baked = baked, .options = options};
    sl_status status = sli_wad_open(context, options->wad, bytes.data, bytes.size, &export.wad);
    if (status == SL_OK) status = export_map(&export, path);
    sli_doom_level_destroy(context, &export.level);
    sli_reject_destroy(context, &export.reject);
    sl_free(context, bytes.data);
    return status;
}

// --- all maps, which are baked here

sl_reject_options sl_reject_options_default(void) {
    const sl_see_options see = sl_see_options_default();
    return (sl_reject_options){.sight = SL_OPEN, .row_bytes = see.row_bytes};
}

void sl_reject_report_destroy(sl_context *context, sl_reject_report *report) {
    sl_free(context, report->maps);
    *report = (sl_reject_report){0};
}

/// A map and what becomes of it.
typedef struct map_work {
    sli_wad_map map;
    sli_reject reject;
    SL_ARRAY(char) notes; ///< lines, each with a 0 behind it
} map_work;

typedef struct wad_job {
    sl_context *context;
    const sl_reject_options *options;
    sl_bytes bytes;
    sli_wad wad;
    SL_ARRAY(map_work) maps;
    size_t *order;    ///< the maps' numbers, the largest map's first
    unsigned at_work; ///< maps at most at once
    unsigned per_map; ///< threads
} wad_job;

static sl_status add_map(wad_job *job, const char *name) {
    sli_wad_map map;
    SL_TRY(sli_wad_find_map(job->context, &job->wad, name, &map));
    for (size_t i = 0; i < job->maps.count; i++)
        if (job->maps.items[i].map.header == map.header)
            return sl_fail(job->context, SL_BAD_ARGUMENT, "map %s is asked for twice", map.name);
    SL_TRY(SL_ARRAY_ROOM(job->context, &job->maps, 1));
    job->maps.items[job->maps.count++] = (map_work){.map = map};
    return SL_OK;
}

static sl_status choose_maps(wad_job *job) {
    for (size_t i = 0; i < job->options->map_count; i++)
        SL_TRY(add_map(job, job->options->maps[i]));
    if (job->options->map_count) return SL_OK;
    sl_map_list list = {0};
    sl_status status =
        sli_map_list_wad(job->context, job->wad.name, job->bytes.data, job->bytes.size, &list);
    for (size_t i = 0; i < list.count && status == SL_OK; i++) status = add_map(job, list.names[i]);
    sl_map_list_destroy(job->context, &list);
    SL_TRY(status);
    if (!job->maps.count) return sl_fail_at(job->context, job->wad.name, 0, "holds no map");
    return SL_OK;
}

/// Bytes of a map's lines, or of its text.
static size_t map_size(const wad_job *job, size_t number) {
    const sli_wad_map *map = &job->maps.items[number].map;
    const char *name = map->is_text ? "TEXTMAP" : "LINEDEFS";
    const uint32_t index = sli_wad_find_lump(&job->wad, map, name);
    if (index == job->wad.lump_count) return 0;
    return sli_wad_u32(job->wad.bytes + job->wad.directory + (size_t)index * 16 + 4);
}

typedef struct sized_map {
    size_t size, number;
} sized_map;

static int compare_sizes(const void *left, const void *right) {
    const sized_map *a = left, *b = right;
    if (a->size != b->size) return a->size > b->size ? -1 : 1;
    return (a->number > b->number) - (a->number < b->number);
}

static sl_status order_maps(wad_job *job) {
    const size_t count = job->maps.count;
    sized_map *sized = sl_alloc_array(job->context, count, sizeof *sized);
    job->order = sl_alloc_array(job->context, count, sizeof *job->order);
    if (sized && job->order) {
        for (size_t i = 0; i < count; i++) sized[i] = (sized_map){map_size(job, i), i};
        qsort(sized, count, sizeof *sized, compare_sizes);
        for (size_t i = 0; i < count; i++) job->order[i] = sized[i].number;
    }
    const sl_status status = sized && job->order ? SL_OK : SL_NO_MEMORY;
    sl_free(job->context, sized);
    return status;
}

/// What a map is on its way to its REJECT.
typedef struct map_state {
    sl_map map;
    sl_space space;
    sl_visibility visibility;
    sli_doom_level level;
} map_state;

static const sl_see_method *find_sweep(void) {
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    while (strcmp(methods->name, "sweep") != 0) methods++;
    return methods;
}

static sl_status see(sl_context *context, const wad_job *job, map_state *state) {
    sl_see_options options = sl_see_options_default();
    options.sight = job->options->sight;
    options.threads = job->per_map;
    options.row_bytes = job->options->row_bytes / job->at_work;
    return find_sweep()->see(context, &state->space, &options, &state->visibility);
}

static sl_status make_reject(sl_context *context, const wad_job *job, map_work *work,
                             map_state *state) {
    sl_import_options import = sl_import_options_default();
    import.map = work->map.name;
    import.sectors = true;
    const sl_subdivide_options rules = sl_subdivide_options_default();
    SL_TRY(sli_doom_read(context, &job->wad, &work->map, &state->level));
    SL_TRY(sli_doom_make_map(context, &job->wad, &work->map, &state->level, &import, true,
                             &state->map));
    char source[SL_LINE_TEXT];
    snprintf(source, sizeof source, "%s: map %s", job->wad.name, work->map.name);
    state->map.source.name = sl_copy_text(context, source, strlen(source));
    if (!state->map.source.name) return SL_NO_MEMORY;
    SL_TRY(sl_map_clean(context, &state->map, NULL, NULL));
    SL_TRY(sl_subdivision_for(&state->map)->subdivide(context, &state->map, &rules, &state->space));
    SL_TRY(see(context, job, state));
    SL_TRY(sli_reject_make(context, &state->space, &state->visibility.pvs, &state->level,
                           &work->reject));
    memcpy(work->reject.account.map, work->map.name, sizeof work->map.name);
    return SL_OK;
}

/// As it, the message led by the map's name.
static sl_status do_map(sl_context *context, const wad_job *job, map_work *work) {
    map_state state = {0};
    const sl_status status = make_reject(context, job, work, &state);
    sli_doom_level_destroy(context, &state.level);
    sl_visibility_destroy(context, &state.visibility);
    sl_space_destroy(context, &state.space);
    sl_map_destroy(context, &state.map);
    if (status != SL_BAD_INPUT && status != SL_UNSUPPORTED) return status;
    char message[sizeof context->message];
    memcpy(message, context->message, sizeof message);
    return sl_fail(context, status, "map %s: %s", work->map.name, message);
}

/// The hooks of one of several maps at work: the caller's, but notes wait until all maps are done.
typedef struct map_hooks {
    sl_context *context; ///< the caller's
    map_work *work;
} map_hooks;

static void *resize_for_map(void *user, void *block, size_t bytes) {
    const sl_hooks *hooks = &((const map_hooks *)user)->context->hooks;
    return hooks->resize(hooks->user, block, bytes);
}

static bool is_cancelled_for_map(void *user) {
    const sl_hooks *hooks = &((const map_hooks *)user)->context->hooks;
    return hooks->cancelled(hooks->user);
}

/// Without memory for it, a note is lost.
static void keep_note(void *user, const char *message) {
    const map_hooks *own = user;
    const size_t size = strlen(message) + 1;
    if (SL_ARRAY_ROOM(own->context, &own->work->notes, size) != SL_OK) return;
    memcpy(own->work->notes.items + own->work->notes.count, message, size);
    own->work->notes.count += size;
}

/// With several maps at work, only the number of maps that are done is reported.
static sl_status do_unit(sl_context *context, void *user, void *state, size_t unit) {
    (void)state;
    wad_job *job = user;
    map_work *work = &job->maps.items[job->order[unit]];
    map_hooks hooks = {context, work};
    sl_context own = *context;
    own.hooks = (sl_hooks){.user = &hooks,
                           .resize = context->hooks.resize ? resize_for_map : NULL,
                           .cancelled = context->hooks.cancelled ? is_cancelled_for_map : NULL,
                           .note = keep_note};
    const sl_status status = do_map(&own, job, work);
    memcpy(context->message, own.message, sizeof own.message);
    return status;
}

static void pass_on_notes(const wad_job *job) {
    for (size_t i = 0; i < job->maps.count; i++) {
        const map_work *work = &job->maps.items[i];
        for (size_t at = 0; at < work->notes.count; at += strlen(work->notes.items + at) + 1)
            sl_note(job->context, "%s", work->notes.items + at);
    }
}

static sl_status make_rejects(wad_job *job) {
    const unsigned threads = job->options->threads ? job->options->threads : sl_core_count();
    job->at_work = threads < job->maps.count ? threads : (unsigned)job->maps.count;
    job->per_map = threads / job->at_work;
    if (job->maps.count == 1) return do_map(job->context, job, &job->maps.items[0]);
    SL_TRY(order_maps(job));
    const sl_work work = {.job = job, .unit = do_unit, .stage = "reject", .units = "maps"};
    const sl_status status = sl_work_run(job->context, &work, job->maps.count, job->at_work);
    if (status == SL_OK) pass_on_notes(job);
    return status;
}

static sl_status write_copy(const wad_job *job, const char *output) {
    sli_wad_edit *edits = sl_alloc_array(job->context, job->maps.count, sizeof *edits);
    if (!edits) return SL_NO_MEMORY;
    for (size_t i = 0; i < job->maps.count; i++) {
        const map_work *work = &job->maps.items[i];
        edits[i] = (sli_wad_edit){
            .map = work->map, .name = "REJECT", .lump = {work->reject.bytes, work->reject.size}};
    }
    const sl_status status = sli_wad_write(job->context, &job->wad, edits, job->maps.count, output);
    sl_free(job->context, edits);
    return status;
}

static sl_status do_wad(wad_job *job, const char *path, const char *output,
                        sl_reject_report *report) {
    SL_TRY(sli_wad_open(job->context, path, job->bytes.data, job->bytes.size, &job->wad));
    SL_TRY(choose_maps(job));
    SL_TRY(make_rejects(job));
    sl_reject_account *accounts = sl_alloc_array(job->context, job->maps.count, sizeof *accounts);
    if (!accounts) return SL_NO_MEMORY;
    for (size_t i = 0; i < job->maps.count; i++) accounts[i] = job->maps.items[i].reject.account;
    const sl_status status = write_copy(job, output);
    if (status == SL_OK)
        *report = (sl_reject_report){accounts, job->maps.count};
    else
        sl_free(job->context, accounts);
    return status;
}

sl_status sl_reject_wad(sl_context *context, const char *path, const sl_reject_options *options,
                        const char *output, sl_reject_report *report) {
    wad_job job = {.context = context, .options = options};
    SL_TRY(sl_file_read(context, path, &job.bytes));
    const sl_status status = do_wad(&job, path, output, report);
    for (size_t i = 0; i < job.maps.count; i++) {
        sli_reject_destroy(context, &job.maps.items[i].reject);
        sl_free(context, job.maps.items[i].notes.items);
    }
    sl_free(context, job.maps.items);
    sl_free(context, job.order);
    sl_free(context, job.bytes.data);
    return status;
}
