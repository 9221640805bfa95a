/// Places to choose from, and what is said of the choice.
#include "studies/place_cameras.h"

#include "arguments/names.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { HEADINGS = 8, MOST_PLACES = 1 << 20 };

camera_plan camera_plan_default(void) {
    return (camera_plan){.like = {.fov = 360}};
}

option_table camera_option_table(camera_plan *plan) {
    const option_spec options[] = {
        {"from", 0, "PLACES",
         "where viewpoints may stand: anywhere, corners, walls, walls:STEP, grid:STEP, or a table "
         "of places, in which a column cost says what each costs (default: anywhere; walls with "
         "one of the options below)",
         .text = &plan->from, .is_input = true},
        {"fov", 0, "DEG", "width of view cones (default: 360, all round)",
         .number = &plan->like.fov, .over_0 = true, .most = 360},
        {"headings", 0, "N", "directions to choose from at each place (default: 8)",
         .count32 = &plan->headings, .least = 1, .most = 360},
        {"range", 0, "R", "how far viewpoints see (default: no limit)", .number = &plan->like.range,
         .over_0 = true},
        {"nearest", 0, "R", "dead zone: viewpoints see nothing nearer", .rare = true,
         .number = &plan->like.nearest, .over_0 = true},
        {"cover", 0, "K", "each point must be seen by K viewpoints (default: 1)",
         .count32 = &plan->cover, .least = 1, .most = 100},
        {"count", 0, "N",
         "see as much as N viewpoints can, beside those of --fixed, in place of everything",
         .count32 = &plan->count, .least = 1, .most = 100000},
        {"network", 0, NULL,
         "lines of sight must join all viewpoints, each to each over others, up to their ranges",
         .flag = &plan->network, .rare = true},
        {"scan-angle", 0, "DEG",
         "scan the walls in place of the area: see each point of them under an angle of at least "
         "this with the wall",
         .number = &plan->scan_angle, .over_0 = true, .most = 89, .rare = true},
        {"scan-range", 0, "R", "scan the walls: see each point of them from R or nearer",
         .number = &plan->scan_range, .over_0 = true, .rare = true},
        {"fixed", 0, "TABLE",
         "viewpoints that stand already; without a column fov they look all round, without range "
         "they see without limit: --fov, --range and --nearest are of new ones",
         .text = &plan->fixed, .is_input = true},
        {"see", 0, "THINGS",
         "what must be seen: names of objects, doors and paths in the map (of shut doors both "
         "sides), a drawing of closed outlines, or a table of corners (.csv: name,x,y) (default: "
         "all that is inside)",
         .text = &plan->see, .is_input = true},
        {"path", 0, "PATH",
         "a route that must be seen: a path of the map, or the points of a CSV table",
         .text = &plan->path, .is_input = true, .rare = true},
        {"weight", 0, "NAME=W,...",
         "with --count: what the area of zones of --see, or the length of lines, is worth "
         "(default: "
         "1); where they overlap, both count",
         .text = &plan->weight, .rare = true},
        {"forbid", 0, "ZONES",
         "where no viewpoint may stand: names of objects, outlines or a table, as --see has them",
         .text = &plan->forbid, .is_input = true},
    };
    option_table table = {0};
    option_table_add(&table, options, sizeof options / sizeof *options);
    return table;
}

bool camera_plan_chooses(const camera_plan *p) {
    return (p->from && strcmp(p->from, "anywhere") != 0) || p->see || p->path || p->forbid ||
           p->fixed || p->like.fov < 360 || p->headings || p->like.range > 0 ||
           p->like.nearest > 0 || p->cover || p->count || p->weight || p->network ||
           p->scan_angle > 0 || p->scan_range > 0;
}

sl_status camera_plan_check(sl_context *context, const camera_plan *p, const char *proof) {
    if (proof && p->count)
        return sl_fail(
            context, SL_BAD_ARGUMENT,
            "--%s does not go with --count: a proof is of witnesses, one by one, and the "
            "bound of --count is a sum of areas or lengths, for which there is no second "
            "code; the report has that bound",
            proof);
    if (proof && (p->network || p->scan_angle > 0 || p->scan_range > 0))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--%s does not go with --network and scans of walls", proof);
    if (p->from && strcmp(p->from, "anywhere") == 0 && camera_plan_chooses(p))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--from anywhere: viewpoints anywhere look all round, without limit, at all "
                       "that is inside; take --from walls, corners, grid:STEP or a table");
    if (p->like.range > 0 && p->like.nearest >= p->like.range)
        return sl_fail(context, SL_BAD_ARGUMENT, "--nearest must be less than --range");
    if (p->weight && (!p->count || !(p->see || p->path) || p->scan_angle > 0 || p->scan_range > 0))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--weight goes with --count and --see or --path, and with no scan of walls");
    if (p->path && proof)
        return sl_fail(context, SL_BAD_ARGUMENT, "--%s does not go with --path", proof);
    if (p->count && p->network)
        return sl_fail(context, SL_BAD_ARGUMENT, "--count and --network do not go together");
    if (p->count && p->cover > 1)
        return sl_fail(context, SL_BAD_ARGUMENT, "--count and --cover do not go together");
    return SL_OK;
}

// --- places

/// "walls:2.5": the step behind a word; false for another word.
static sl_status read_step(sl_context *context, const char *text, const char *word, double *step,
                           bool *is_word) {
    const size_t length = strlen(word);
    *is_word = strncmp(text, word, length) == 0 && (!text[length] || text[length] == ':');
    if (!*is_word || !text[length]) return SL_OK;
    SL_TRY(read_number(context, "--from", text + length + 1, step));
    return *step > 0
               ? SL_OK
               : sl_fail(context, SL_BAD_ARGUMENT, "--from %s: the step must be more than 0", text);
}

/// Adds a place, once for each heading that it may have.
static sl_status add_place(sl_context *context, const camera_plan *plan, const sl_camera *camera,
                           bool turns, camera_work *w) {
    sl_camera turned = *camera;
    const uint32_t headings = plan->headings ? plan->headings : HEADINGS;
    const uint32_t count = turns && camera->view.fov < 360 ? headings : 1;
    if (w->places.count + count > MOST_PLACES)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "more than %d places and headings: take a longer step or fewer headings",
                       (int)MOST_PLACES);
    w->points++;
    for (uint32_t h = 0; h < count; h++) {
        if (turns) turned.view.heading = 360.0 * h / count;
        SL_TRY(sl_cameras_add(context, &w->places, &turned));
    }
    return SL_OK;
}

/// Whether a viewpoint sees nothing, as one on a wall that looks at the wall's other side.
static sl_status is_blind(sl_context *context, sl_query *query, const sl_viewpoint *place,
                          bool *blind) {
    const sl_view view = sl_query_view(query, place->at, place->heading, place->fov);
    sl_region region = {0};
    const sl_status status = sl_query_region(context, query, &view, &region);
    *blind = status == SL_OK && !(sl_region_area(&region) > 0);
    sl_region_destroy(context, &region);
    return status;
}

static sl_status add_table(sl_context *context, const camera_plan *plan, const zone_list *forbid,
                           const sl_space *space, sl_query *query, camera_work *w) {
    sl_cameras table = {0};
    if (strcmp(plan->from, "-") != 0 && sl_path_look(plan->from) == SL_PATH_NOTHING)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--from: '%s' is no file; places are anywhere, corners, walls, walls:STEP, "
                       "grid:STEP or a table",
                       plan->from);
    SL_TRY(sl_cameras_read(context, plan->from, &plan->like, &table));
    sl_status status = SL_OK;
    uint32_t blind = 0, first = 0;
    for (size_t i = 0; status == SL_OK && i < table.count; i++) {
        const sl_camera *camera = &table.items[i];
        status = input_check_place(context, plan->from, camera->line, space, camera->view.at);
        if (status != SL_OK) break;
        if (zones_hold(forbid, camera->view.at))
            w->forbidden++;
        else
            status = add_place(context, plan, camera, plan->headings > 0, w);
        bool sees_nothing = false;
        if (status == SL_OK && !plan->headings)
            status = is_blind(context, query, &camera->view, &sees_nothing);
        if (sees_nothing && !blind++) first = camera->line;
    }
    if (status == SL_OK && blind)
        sl_note(context,
                "%s: %u of %zu places see nothing, the first on line %u: one that stands on a wall "
                "looks from one side of it; put it a little before the wall",
                plan->from, blind, table.count, first);
    sl_cameras_destroy(context, &table);
    return status;
}

static sl_status add_points(sl_context *context, const camera_plan *plan, const zone_list *forbid,
                            const sl_space *space, sl_query *query, camera_work *w) {
    const char *from = plan->from ? plan->from : "walls";
    double step = 0;
    bool corners, walls = false, grid = false;
    SL_TRY(read_step(context, from, "corners", &step, &corners));
    if (!corners) SL_TRY(read_step(context, from, "walls", &step, &walls));
    if (!corners && !walls) SL_TRY(read_step(context, from, "grid", &step, &grid));
    if (!corners && !walls && !grid) return add_table(context, plan, forbid, space, query, w);
    if (grid && !(step > 0))
        return sl_fail(context, SL_BAD_ARGUMENT, "--from grid: give the step, as grid:0.5");
    if (walls && !(step > 0)) step = sl_place_step(space, plan->like.range);
    sl_point *points = NULL;
    uint32_t count = 0;
    SL_TRY(sl_place_points(context, query,
                           corners ? SL_PLACE_CORNERS
                           : walls ? SL_PLACE_WALLS
                                   : SL_PLACE_GRID,
                           step, &points, &count));
    sl_status status = SL_OK;
    for (uint32_t i = 0; status == SL_OK && i < count; i++) {
        sl_camera camera = {.view = plan->like, .cost = 1};
        camera.view.at = points[i];
        if (zones_hold(forbid, points[i]))
            w->forbidden++;
        else
            status = add_place(context, plan, &camera, true, w);
    }
    sl_free(context, points);
    return status;
}

/// Notes viewpoints that stand already and see farther or wider than new ones may.
static void note_unlimited(sl_context *context, const camera_plan *plan, const camera_work *w) {
    unsigned round = 0, far = 0;
    for (uint32_t i = 0; i < w->task.fixed_count; i++) {
        const sl_viewpoint *view = &w->places.items[i].view;
        round += plan->like.fov < 360 && view->fov == 360;
        far += plan->like.range > 0 && view->range == 0;
    }
    if (round)
        sl_note(
            context,
            "%s: rows that look all round: %u of %u; --fov is of new viewpoints, a column fov of "
            "these",
            plan->fixed, round, w->task.fixed_count);
    if (far)
        sl_note(context,
                "%s: rows that see without limit: %u of %u; --range is of new viewpoints, a column "
                "range of these",
                plan->fixed, far, w->task.fixed_count);
}

static sl_status add_fixed(sl_context *context, const camera_plan *plan, const sl_space *space,
                           camera_work *w) {
    const sl_viewpoint like = camera_plan_default().like; // --fov and --range are of new ones
    SL_TRY(sl_cameras_read(context, plan->fixed, &like, &w->places));
    w->task.fixed_count = (uint32_t)w->places.count;
    w->fixed = sl_alloc_array(context, w->places.count, sizeof *w->fixed);
    if (!w->fixed) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < w->task.fixed_count; i++) {
        const sl_camera *camera = &w->places.items[i];
        w->fixed[i] = i;
        SL_TRY(input_check_place(context, plan->fixed, camera->line, space, camera->view.at));
    }
    note_unlimited(context, plan, w);
    return SL_OK;
}

/// Costs as whole numbers: times 1, 10, 100 or 1000.
static sl_status make_costs(sl_context *context, camera_work *w) {
    w->costs = sl_alloc_array(context, w->places.count, sizeof *w->costs);
    w->views = sl_alloc_array(context, w->places.count, sizeof *w->views);
    if (!w->costs || !w->views) return SL_NO_MEMORY;
    for (w->scale = 1; w->scale <= 1000; w->scale *= 10) {
        bool whole = true;
        for (size_t i = 0; i < w->places.count && whole; i++) {
            const double cost = w->places.items[i].cost * w->scale;
            whole = fabs(cost - round(cost)) <= 1e-9 * cost && cost >= 1 && cost <= 1e6;
            if (whole) w->costs[i] = (uint32_t)round(cost);
        }
        for (size_t i = 0; i < w->places.count; i++) w->views[i] = w->places.items[i].view;
        if (whole) return SL_OK;
    }
    return sl_fail(context, SL_BAD_INPUT,
                   "costs must be over 0 and up to 1,000,000, with up to three decimals");
}

/// One "NAME=W" of `length`.
static sl_status read_weight(sl_context *context, const char *text, size_t length, camera_work *w) {
    char name[256], number[64];
    const char *equals = NULL;
    for (size_t i = 0; i < length; i++)
        if (text[i] == '=') equals = text + i;
    const size_t size = equals ? (size_t)(equals - text) : 0, rest = length - size;
    double weight;
    if (!size || size >= sizeof name || rest < 2 || rest > sizeof number)
        return sl_fail(context, SL_BAD_ARGUMENT, "--weight %.*s: give NAME=W, as vault=5",
                       (int)length, text);
    snprintf(name, sizeof name, "%.*s", (int)size, text);
    snprintf(number, sizeof number, "%.*s", (int)(rest - 1), equals + 1);
    SL_TRY(read_number(context, "--weight", number, &weight));
    if (!(weight > 0))
        return sl_fail(context, SL_BAD_ARGUMENT, "--weight %s: a weight must be more than 0", name);
    bool found = false;
    for (size_t z = 0; z < w->see.ends.count; z++) {
        if (strcmp(w->see.names.items[z], name) != 0) continue;
        w->weights[z] = weight;
        found = true;
    }
    for (size_t i = 0; i < w->lines.segments.count; i++) {
        if (strcmp(w->lines.names.items[see_lines_of(&w->lines, i)], name) != 0) continue;
        w->line_weights[i] = weight;
        found = true;
    }
    return found ? SL_OK
                 : sl_fail(context, SL_BAD_ARGUMENT, "--weight: '%s' is none of what is to be seen",
                           name);
}

static sl_status make_weights(sl_context *context, const camera_plan *plan, camera_work *w) {
    const size_t count = w->see.ends.count, lines = w->lines.segments.count;
    w->zones = sl_alloc_array(context, count, sizeof *w->zones);
    w->zone_ends = sl_alloc_array(context, count, sizeof *w->zone_ends);
    w->weights = sl_alloc_array(context, count, sizeof *w->weights);
    w->line_weights = sl_alloc_array(context, lines, sizeof *w->line_weights);
    if (!w->zones || !w->zone_ends || !w->weights || !w->line_weights) return SL_NO_MEMORY;
    for (size_t i = 0; i < lines; i++) w->line_weights[i] = 1;
    for (size_t z = 0; z < count; z++) {
        w->zones[z] = zones_shape_of(&w->see, z, &w->zone_ends[z]);
        w->weights[z] = 1;
    }
    for (const char *at = plan->weight; *at;) {
        const size_t length = strcspn(at, ",");
        SL_TRY(read_weight(context, at, length, w));
        at += length + (at[length] == ',');
    }
    w->task.zones = w->zones;
    w->task.weights = w->weights;
    w->task.zone_count = (uint32_t)count;
    w->task.line_weights = w->line_weights;
    return SL_OK;
}

/// What is to be seen: zones and lines.
static sl_status read_things(sl_context *context, const camera_plan *plan,
                             const input_options *input, const sl_baked *baked, camera_work *w) {
    char *rest = NULL;
    sl_status status = SL_OK;
    if (plan->see && (sl_path_look(plan->see) == SL_PATH_FILE || name_ends_with(plan->see, ".csv")))
        status = zones_read(context, "see", plan->see, input, &baked->map, &w->see);
    else if (plan->see)
        status = see_lines_take(context, plan->see, baked, &w->lines, &rest);
    if (status == SL_OK && rest && *rest)
        status = zones_read(context, "see", rest, input, &baked->map, &w->see);
    sl_free(context, rest);
    if (status == SL_OK && plan->path)
        status = see_lines_add_path(context, plan->path, &baked->map, &w->lines);
    SL_TRY(status);
    SL_TRY(see_lines_check(context, baked, &w->lines));
    if (w->see.ends.count) {
        w->shape = zones_shape(&w->see);
        w->task.see = &w->shape;
    }
    w->task.lines = w->lines.segments.items;
    w->task.line_count = (uint32_t)w->lines.segments.count;
    return plan->weight ? make_weights(context, plan, w) : SL_OK;
}

/// Notes a range that limits nothing: often the map's unit is another one.
static void note_long_range(sl_context *context, const camera_plan *plan, const sl_baked *baked) {
    const sl_space *s = &baked->space;
    const char *unit = baked->map.unit;
    sl_box box = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (uint32_t c = 0; c < s->cell_count; c++)
        for (uint32_t i = 0; s->cells[c].inside && i < s->cells[c].vertex_count; i++) {
            const sl_point p = s->vertices[s->cells[c].first_vertex + i];
            box.min = (sl_point){fmin(box.min.x, p.x), fmin(box.min.y, p.y)};
            box.max = (sl_point){fmax(box.max.x, p.x), fmax(box.max.y, p.y)};
        }
    const double width = box.max.x - box.min.x, height = box.max.y - box.min.y;
    if (!(plan->like.range > hypot(width, height))) return;
    sl_note(context,
            "--range %g reaches over the whole plan of %.3g by %.3g%s%s, so it limits nothing%s",
            plan->like.range, width, height, *unit ? " " : "", unit,
            *unit ? "; if a drawing is in another unit, --unit says so, as --unit ft=m" : "");
}

sl_status camera_work_prepare(sl_context *context, const camera_plan *plan,
                              const input_options *input, const sl_baked *baked, sl_query *query,
                              camera_work *w) {
    const sl_space *space = &baked->space;
    zone_list forbid = {0};
    note_long_range(context, plan, baked);
    SL_TRY(read_things(context, plan, input, baked, w));
    if (plan->fixed) SL_TRY(add_fixed(context, plan, space, w));
    if (plan->forbid)
        SL_TRY(zones_read(context, "forbid", plan->forbid, input, &baked->map, &forbid));
    sl_status status = add_points(context, plan, &forbid, space, query, w);
    zones_destroy(context, &forbid);
    SL_TRY(status);
    if (!w->points)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "no place is left to choose: --forbid has all %zu of them", w->forbidden);
    SL_TRY(make_costs(context, w));
    w->task.places = w->views;
    w->task.place_count = (uint32_t)w->places.count;
    w->task.costs = w->costs;
    w->task.fixed = w->fixed;
    w->task.cover = plan->cover;
    w->task.count = plan->count;
    w->task.network = plan->network;
    w->task.scan_angle = plan->scan_angle;
    w->task.scan_range = plan->scan_range;
    return SL_OK;
}

sl_status camera_work_chosen(sl_context *context, const camera_work *w, sl_cameras *out) {
    for (uint32_t i = 0; i < w->placed.count; i++)
        SL_TRY(sl_cameras_add(context, out, &w->places.items[w->placed.chosen[i]]));
    return SL_OK;
}

void camera_work_destroy(sl_context *context, camera_work *w) {
    sl_cameras_destroy(context, &w->places);
    sl_free(context, w->views);
    sl_free(context, w->costs);
    sl_free(context, w->fixed);
    zones_destroy(context, &w->see);
    sl_free(context, w->zones);
    sl_free(context, w->zone_ends);
    sl_free(context, w->weights);
    see_lines_destroy(context, &w->lines);
    sl_free(context, w->line_weights);
    cover_zones_destroy(context, &w->covers);
    sl_free(context, w->line_covers);
    sl_area_placement_destroy(context, &w->placed);
}
