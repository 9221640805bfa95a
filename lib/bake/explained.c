/// What reports say of an explained pair beside the explanation itself, and its JSON.
///
/// An explanation knows the space. The file adds what was baked: its answer, by its method, with
/// the doors as they are. The map adds names: which doors stand on the way. All members of the JSON
/// are written in one pass, so that nothing is kept in memory but a flag for each door.
#include "sightline/explained.h"

#include "cell_to_cell/pvs_rows.h"
#include "effects/filtered.h"
#include "sightline/json.h"
#include "sightline/support.h"

#include <string.h>

sl_said sl_explained_said(const sl_explained *a) {
    const sl_visibility *v = &a->baked->visibility;
    const sl_explanation *e = &a->e.now;
    if (!sl_pvs_count(&v->pvs, e->from)) return SL_SAID_NOTHING;
    return sl_pvs_sees(&v->pvs, e->from, e->to) &&
                   sli_door_sets_open(&v->doors, e->from, e->to, a->shut)
               ? SL_SAID_SEEN
               : SL_SAID_HIDDEN;
}

bool sl_explained_is_doubtful(const sl_explained *a) {
    const sl_pvs *doubtful = &a->baked->visibility.doubtful;
    return doubtful->cell_count && sl_pvs_sees(doubtful, a->e.now.from, a->e.now.to);
}

// --- ways

sl_way sl_way_direct(const sl_explanation *e) {
    return (sl_way){&e->sequence, NULL, e->length};
}

sl_way sl_way_bent(const sl_bent_sightline *bent) {
    return (sl_way){NULL, bent, bent->length};
}

uint32_t sl_way_count(const sl_way *way) {
    return way->bent ? way->bent->step_count : way->sequence->directed_count;
}

uint32_t sl_way_at(const sl_way *way, uint32_t step) {
    return way->bent ? way->bent->steps[step].directed : way->sequence->directed[step];
}

const sl_seam *sl_way_seam(const sl_space *space, const sl_way *way, uint32_t step,
                           sl_seam_kind kind) {
    const uint32_t directed = sl_way_at(way, step);
    if (directed == UINT32_MAX) return NULL;
    size_t count;
    const sl_seam_portal *on = sl_space_seams_of(space, space->directed[directed].portal, &count);
    for (size_t i = 0; i < count; i++)
        if (space->seams[on[i].seam].kind == kind) return &space->seams[on[i].seam];
    return NULL;
}

bool sl_way_doors(const sl_explained *a, const sl_way *way, bool shut, bool *marked) {
    bool any = false;
    for (size_t i = 0; i < a->baked->map.door_count; i++) marked[i] = false;
    for (uint32_t i = 0; i < sl_way_count(way); i++) {
        const sl_seam *door = sl_way_seam(&a->baked->space, way, i, SL_SEAM_DOOR);
        if (door && a->shut[door->number] == shut) any = marked[door->number] = true;
    }
    return any;
}

bool sl_way_is_dark(const sl_explained *a, const sl_way *way, uint32_t step) {
    const sl_space *space = &a->baked->space;
    const uint32_t directed = sl_way_at(way, step);
    uint32_t from = a->e.now.from;
    if (step)
        from = way->bent ? way->bent->steps[step - 1].cell
                         : space->directed[sl_way_at(way, step - 1)].cell;
    return directed != UINT32_MAX && sli_portal_is_blocked(space, from, directed);
}

bool sl_door_is_first(const sl_map *map, const bool *marked, size_t door) {
    for (size_t i = 0; i < door; i++)
        if (marked[i] && strcmp(map->doors[i].name, map->doors[door].name) == 0) return false;
    return marked[door];
}

// --- JSON

static const char *const verdicts[] = {
    [SL_HIDDEN] = "hidden", [SL_GRAZING] = "grazing", [SL_STABBED] = "stabbed"};

static const char *sight_name(sl_sight sight) {
    return sight == SL_OPEN ? "open" : "closed";
}

static void add_count(sl_json_writer *json, const char *key, uint64_t count) {
    sl_json_put_key(json, key);
    sl_json_put_integer(json, (int64_t)count);
}

static void add_flag(sl_json_writer *json, const char *key, bool flag) {
    sl_json_put_key(json, key);
    sl_json_put_flag(json, flag);
}

static void add_text(sl_json_writer *json, const char *key, const char *text) {
    sl_json_put_key(json, key);
    sl_json_put_text(json, text);
}

static void begin_list(sl_json_writer *json, const char *key) {
    sl_json_put_key(json, key);
    sl_json_put_list(json);
}

static void begin_object(sl_json_writer *json, const char *key) {
    sl_json_put_key(json, key);
    sl_json_put_object(json);
}

static void put_point(sl_json_writer *json, sl_point point) {
    sl_json_put_list(json);
    sl_json_put_real(json, point.x);
    sl_json_put_real(json, point.y);
    sl_json_put_end(json, ']');
}

static void add_point(sl_json_writer *json, const char *key, sl_point point) {
    sl_json_put_key(json, key);
    put_point(json, point);
}

/// [x0, y0, x1, y1]
static void add_segment(sl_json_writer *json, const char *key, sl_point a, sl_point b) {
    const double numbers[] = {a.x, a.y, b.x, b.y};
    begin_list(json, key);
    for (int i = 0; i < 4; i++) sl_json_put_real(json, numbers[i]);
    sl_json_put_end(json, ']');
}

static void put_portal(sl_json_writer *json, const sl_directed_portal *directed) {
    sl_json_put_object(json);
    add_count(json, "portal", directed->portal);
    add_count(json, "cell", directed->cell);
    add_point(json, "left", directed->left);
    add_point(json, "right", directed->right);
    sl_json_put_end(json, '}');
}

static void add_portals(sl_json_writer *json, const sl_space *space, const sl_sequence *sequence,
                        uint32_t count) {
    begin_list(json, "sequence");
    for (uint32_t i = 0; i < count; i++) put_portal(json, &space->directed[sequence->directed[i]]);
    sl_json_put_end(json, ']');
}

static void add_ends(sl_json_writer *json, const sl_space *space, const sl_sequence *sequence) {
    begin_list(json, "ends");
    for (uint32_t i = 0; i < sequence->end_count; i++) {
        const sl_stab_end end = sequence->ends[i];
        sl_json_put_object(json);
        add_count(json, "portal", space->directed[sequence->directed[end.portal]].portal);
        add_text(json, "side", end.left ? "left" : "right");
        add_point(json, "point", sl_sequence_end(space, sequence, end));
        sl_json_put_end(json, '}');
    }
    sl_json_put_end(json, ']');
}

static void put_miss(sl_json_writer *json, const sl_space *space, const sl_miss *miss) {
    const uint32_t last = miss->sequence.directed_count - 1;
    sl_json_put_object(json);
    add_portals(json, space, &miss->sequence, last);
    sl_json_put_key(json, "stopped_by");
    put_portal(json, &space->directed[miss->sequence.directed[last]]);
    add_text(json, "reason", miss->turns ? "turn" : "conflict");
    add_count(json, "missing", miss->missing);
    add_ends(json, space, &miss->sequence);
    sl_json_put_end(json, '}');
}

static void add_file(sl_json_writer *json, const sl_explained *a) {
    const sl_baked *baked = a->baked;
    const sl_said said = sl_explained_said(a);
    begin_object(json, "file");
    add_text(json, "sight", sight_name(baked->visibility.sight));
    add_text(json, "method", baked->method);
    add_text(json, "guarantee", sl_guarantee_name(baked->visibility.guarantee));
    sl_json_put_key(json, "seen");
    if (said == SL_SAID_NOTHING)
        sl_json_put_null(json);
    else
        sl_json_put_flag(json, said == SL_SAID_SEEN);
    add_flag(json, "doubtful", sl_explained_is_doubtful(a));
    sl_json_put_end(json, '}');
}

static void add_found(sl_json_writer *json, const sl_space *space, const sl_explanation *e) {
    if (!e->sequence.directed_count) return;
    add_portals(json, space, &e->sequence, e->sequence.directed_count);
    add_segment(json, "line", e->witness.a, e->witness.b);
    add_flag(json, "touches", e->touches);
    add_segment(json, "shown", e->shown.a, e->shown.b);
    if (e->verdict == SL_GRAZING) add_ends(json, space, &e->sequence);
}

static void add_names(sl_json_writer *json, const char *key, unsigned effects) {
    size_t count;
    const sl_effect *const *all = sl_effects(&count);
    begin_list(json, key);
    for (size_t i = 0; i < count; i++)
        if (effects >> i & 1) sl_json_put_text(json, all[i]->name);
    sl_json_put_end(json, ']');
}

/// "effects": {"decides": [...], "without": [...], "doors": [...], "length": l}; the doors that the
/// way passes, or that are shut on the way that it would take. `marked` is scratch.
static void add_effects(sl_json_writer *json, const sl_explained *a,
                        const sl_effect_verdict *verdict, const sl_way *way, bool *marked) {
    const sl_map *map = &a->baked->map;
    if (!sl_plan_make(map).effects) return;
    begin_object(json, "effects");
    add_names(json, "decides", verdict->decides);
    add_names(json, "without", verdict->without);
    sl_way_doors(a, way, !verdict->seen, marked);
    begin_list(json, "doors");
    for (size_t i = 0; i < map->door_count; i++)
        if (sl_door_is_first(map, marked, i)) sl_json_put_text(json, map->doors[i].name);
    sl_json_put_end(json, ']');
    if (map->range > 0 && sl_way_count(way)) {
        sl_json_put_key(json, "length");
        sl_json_put_real(json, way->length);
    }
    sl_json_put_end(json, '}');
}

static void put_step(sl_json_writer *json, const sl_space *space, const sl_bent_step *step) {
    const bool portal = step->mirror == UINT32_MAX;
    sl_json_put_object(json);
    if (portal)
        add_count(json, "portal", space->directed[step->directed].portal);
    else
        add_count(json, "mirror", step->mirror);
    add_count(json, "cell", step->cell);
    sl_json_put_end(json, '}');
}

static void add_bent(sl_json_writer *json, const sl_explained *a, bool *marked) {
    const sl_bent_sightline *bent = &a->e.now.bent;
    begin_object(json, "by_mirror");
    add_text(json, "verdict", verdicts[bent->verdict]);
    add_flag(json, "complete", bent->complete);
    add_count(json, "tests", bent->tests);
    add_flag(json, "rounded", bent->rounded);
    add_count(json, "mirrors", bent->mirrors);
    begin_list(json, "steps");
    for (uint32_t i = 0; i < bent->step_count; i++)
        put_step(json, &a->baked->space, &bent->steps[i]);
    sl_json_put_end(json, ']');
    begin_list(json, "line");
    for (uint32_t i = 0; bent->bends && i < bent->mirrors + 2; i++) put_point(json, bent->bends[i]);
    sl_json_put_end(json, ']');
    const sl_way way = sl_way_bent(a->e.mirrored.without ? &a->e.bent_without : bent);
    if (a->e.effects) add_effects(json, a, &a->e.mirrored, &way, marked);
    sl_json_put_end(json, '}');
}

static void put_answer(sl_json_writer *json, const sl_explained *a, bool *marked) {
    const sl_space *space = &a->baked->space;
    const sl_explanation *e = &a->e.now;
    sl_json_put_object(json);
    add_count(json, "from", e->from);
    add_count(json, "to", e->to);
    add_text(json, "sight", sight_name(e->sight));
    add_flag(json, "seen", e->seen);
    add_text(json, "verdict", verdicts[e->verdict]);
    add_flag(json, "complete", e->complete);
    add_count(json, "tests", e->tests);
    sl_json_put_key(json, "distance");
    if (e->distance == SL_NO_WAY)
        sl_json_put_null(json);
    else
        sl_json_put_integer(json, e->distance);
    add_found(json, space, e);
    begin_list(json, "misses");
    for (uint32_t i = 0; i < e->miss_count; i++) put_miss(json, space, &e->misses[i]);
    sl_json_put_end(json, ']');
    add_file(json, a);
    const sl_way way = sl_way_direct(a->e.direct.without ? &a->e.without : e);
    add_effects(json, a, &a->e.direct, &way, marked);
    if (e->bent.asked) add_bent(json, a, marked);
    sl_json_put_end(json, '}');
}

sl_status sl_explained_json(sl_context *context, const sl_explained *a, FILE *stream) {
    bool *marked = sl_alloc_array(context, a->baked->map.door_count, sizeof *marked);
    if (!marked) return SL_NO_MEMORY;
    sl_json_writer json = sl_json_writer_to(stream, 2);
    put_answer(&json, a, marked);
    putc('\n', stream);
    sl_free(context, marked);
    return json.failed ? sl_fail(context, SL_BAD_INPUT, "explain: a number is not finite") : SL_OK;
}
