/// The JSON of `sightline explain`.
#include "explain_answer.h"
#include "json_print.h"
#include "names.h"
#include "sightline/support.h"

static uint32_t portal_of(const sl_space *space, const sl_sequence *sequence, uint32_t number) {
    return space->directed[sequence->directed[number]].portal;
}

static void add_segment(json_fields *fields, const char *key, sl_point a, sl_point b) {
    json_add_box(fields, key, (sl_box){a, b});
}

static void put_portal(sl_json_writer *json, const sl_directed_portal *directed) {
    sl_json_put_object(json);
    sl_json_put_key(json, "portal");
    sl_json_put_integer(json, directed->portal);
    sl_json_put_key(json, "cell");
    sl_json_put_integer(json, directed->cell);
    sl_json_put_key(json, "left");
    json_put_point(json, directed->left);
    sl_json_put_key(json, "right");
    json_put_point(json, directed->right);
    sl_json_put_end(json, '}');
}

static void put_portals(sl_json_writer *json, const sl_space *space, const sl_sequence *sequence,
                        uint32_t count) {
    sl_json_put_list(json);
    for (uint32_t i = 0; i < count; i++) put_portal(json, &space->directed[sequence->directed[i]]);
    sl_json_put_end(json, ']');
}

static void put_ends(sl_json_writer *json, const sl_space *space, const sl_sequence *sequence) {
    sl_json_put_list(json);
    for (uint32_t i = 0; i < sequence->end_count; i++) {
        const sl_stab_end end = sequence->ends[i];
        sl_json_put_object(json);
        sl_json_put_key(json, "portal");
        sl_json_put_integer(json, portal_of(space, sequence, end.portal));
        sl_json_put_key(json, "side");
        sl_json_put_text(json, end.left ? "left" : "right");
        sl_json_put_key(json, "point");
        json_put_point(json, sl_sequence_end(space, sequence, end));
        sl_json_put_end(json, '}');
    }
    sl_json_put_end(json, ']');
}

static void put_miss(sl_json_writer *json, const sl_space *space, const sl_miss *miss) {
    const uint32_t last = miss->sequence.directed_count - 1;
    sl_json_put_object(json);
    sl_json_put_key(json, "sequence");
    put_portals(json, space, &miss->sequence, last);
    sl_json_put_key(json, "stopped_by");
    put_portal(json, &space->directed[miss->sequence.directed[last]]);
    sl_json_put_key(json, "reason");
    sl_json_put_text(json, miss->turns ? "turn" : "conflict");
    sl_json_put_key(json, "missing");
    sl_json_put_integer(json, (int64_t)miss->missing);
    sl_json_put_key(json, "ends");
    put_ends(json, space, &miss->sequence);
    sl_json_put_end(json, '}');
}

static void add_file(json_fields *fields, const answer *a) {
    const sl_baked *baked = a->baked;
    const said what = said_by(a);
    json_fields inner = json_begin();
    json_add_text(&inner, "sight", sight_name(baked->visibility.sight));
    json_add_text(&inner, "method", baked->method);
    json_add_text(&inner, "guarantee", sl_guarantee_name(baked->visibility.guarantee));
    if (what == SAID_NOTHING)
        json_add_text(&inner, "seen", NULL);
    else
        json_add_flag(&inner, "seen", what == SAID_SEEN);
    json_add_flag(&inner, "doubtful", is_doubtful(a));
    json_add_fields(fields, "file", &inner);
}

static void add_found(json_fields *fields, const sl_space *space, const sl_explanation *e) {
    if (!e->sequence.directed_count) return;
    put_portals(json_add(fields, "sequence"), space, &e->sequence, e->sequence.directed_count);
    add_segment(fields, "line", e->witness.a, e->witness.b);
    json_add_flag(fields, "touches", e->touches);
    add_segment(fields, "shown", e->shown.a, e->shown.b);
    if (e->verdict == SL_GRAZING) put_ends(json_add(fields, "ends"), space, &e->sequence);
}

static void put_effects(sl_json_writer *json, unsigned effects) {
    sl_json_put_list(json);
    for (size_t i = 0; i < HIDING; i++)
        if (effects & hiding[i].bit) sl_json_put_text(json, hiding[i].name);
    sl_json_put_end(json, ']');
}

static void put_doors(sl_json_writer *json, const sl_map *map, const bool *marked) {
    sl_json_put_list(json);
    for (size_t i = 0; i < map->door_count; i++)
        if (is_first(map, marked, i)) sl_json_put_text(json, map->doors[i].name);
    sl_json_put_end(json, ']');
}

/// "effects": {"decides": [...], "without": [...], "doors": [...], "length": l}; the doors that the
/// way passes, or that are shut on the way that it would take.
static void add_effects(json_fields *fields, const answer *a, const sl_effect_verdict *verdict,
                        const way *w, bool *scratch) {
    if (!sl_plan_make(&a->baked->map).effects) return;
    json_fields inner = json_begin();
    put_effects(json_add(&inner, "decides"), verdict->decides);
    put_effects(json_add(&inner, "without"), verdict->without);
    mark_doors(a, w, !verdict->seen, scratch);
    put_doors(json_add(&inner, "doors"), &a->baked->map, scratch);
    if (a->baked->map.range > 0 && way_count(w)) json_add_real(&inner, "length", w->length);
    json_add_fields(fields, "effects", &inner);
}

static void add_bent(json_fields *fields, const answer *a, const char *verdict, bool *scratch) {
    const sl_space *space = &a->baked->space;
    const sl_bent_sightline *bent = &a->e.now.bent;
    json_fields inner = json_begin();
    json_add_text(&inner, "verdict", verdict);
    json_add_flag(&inner, "complete", bent->complete);
    json_add_count(&inner, "tests", bent->tests);
    json_add_flag(&inner, "rounded", bent->rounded);
    json_add_count(&inner, "mirrors", bent->mirrors);
    sl_json_writer *json = json_add(&inner, "steps");
    sl_json_put_list(json);
    for (uint32_t i = 0; i < bent->step_count; i++) {
        const sl_bent_step *step = &bent->steps[i];
        const bool portal = step->mirror == UINT32_MAX;
        sl_json_put_object(json);
        sl_json_put_key(json, portal ? "portal" : "mirror");
        sl_json_put_integer(json, portal ? space->directed[step->directed].portal : step->mirror);
        sl_json_put_key(json, "cell");
        sl_json_put_integer(json, step->cell);
        sl_json_put_end(json, '}');
    }
    sl_json_put_end(json, ']');
    json_add_points(&inner, "line", bent->bends, bent->bends ? bent->mirrors + 2 : 0);
    const way w = way_bent(a->e.mirrored.without ? &a->e.bent_without : bent);
    if (a->e.effects) add_effects(&inner, a, &a->e.mirrored, &w, scratch);
    json_add_fields(fields, "by_mirror", &inner);
}

sl_status explanation_print_json(sl_context *context, const answer *a, bool *scratch,
                                 FILE *stream) {
    const sl_baked *baked = a->baked;
    const sl_explanation *e = &a->e.now;
    static const char *const verdicts[] = {
        [SL_HIDDEN] = "hidden", [SL_GRAZING] = "grazing", [SL_STABBED] = "stabbed"};
    json_fields fields = json_begin();
    json_add_count(&fields, "from", e->from);
    json_add_count(&fields, "to", e->to);
    json_add_text(&fields, "sight", sight_name(e->sight));
    json_add_flag(&fields, "seen", e->seen);
    json_add_text(&fields, "verdict", verdicts[e->verdict]);
    json_add_flag(&fields, "complete", e->complete);
    json_add_count(&fields, "tests", e->tests);
    if (e->distance == SL_NO_WAY)
        json_add_text(&fields, "distance", NULL);
    else
        json_add_count(&fields, "distance", e->distance);
    add_found(&fields, &baked->space, e);
    sl_json_writer *misses = json_add(&fields, "misses");
    sl_json_put_list(misses);
    for (uint32_t i = 0; i < e->miss_count; i++) put_miss(misses, &baked->space, &e->misses[i]);
    sl_json_put_end(misses, ']');
    add_file(&fields, a);
    const way w = way_direct(a->e.direct.without ? &a->e.without : e);
    add_effects(&fields, a, &a->e.direct, &w, scratch);
    if (e->bent.asked) add_bent(&fields, a, verdicts[e->bent.verdict], scratch);
    return json_print_to(context, &fields, stream);
}
