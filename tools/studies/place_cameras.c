/// Places to choose from, and what is said of the choice.
#include "studies/place_cameras.h"

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
         "of places (default: anywhere; walls with one of the options below)",
         .text = &plan->from},
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
        {"count", 0, "N", "see as much as N viewpoints can, in place of everything",
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
        {"fixed", 0, "TABLE", "viewpoints that stand already", .text = &plan->fixed,
         .is_input = true},
        {"see", 0, "ZONES",
         "what must be seen: names of objects in the map, a drawing of closed outlines, or a table "
         "of corners (.csv: name,x,y) (default: all that is inside)",
         .text = &plan->see},
        {"weight", 0, "NAME=W,...",
         "with --count and --see: what the area of these zones is worth (default: 1); where zones "
         "overlap, both count",
         .text = &plan->weight, .rare = true},
        {"forbid", 0, "ZONES", "where no viewpoint may stand, given as --see is",
         .text = &plan->forbid},
    };
    option_table table = {0};
    option_table_add(&table, options, sizeof options / sizeof *options);
    return table;
}

bool camera_plan_chooses(const camera_plan *p) {
    return (p->from && strcmp(p->from, "anywhere") != 0) || p->see || p->forbid || p->fixed ||
           p->like.fov < 360 || p->headings || p->like.range > 0 || p->like.nearest > 0 ||
           p->cover || p->count || p->weight || p->network || p->scan_angle > 0 ||
           p->scan_range > 0;
}

sl_status camera_plan_check(sl_context *context, const camera_plan *p, const char *proof) {
    if (proof && (p->count || p->network || p->scan_angle > 0 || p->scan_range > 0))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--%s does not go with --count, --network and scans of walls", proof);
    if (p->from && strcmp(p->from, "anywhere") == 0 && camera_plan_chooses(p))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--from anywhere: viewpoints anywhere look all round, without limit, at all "
                       "that is inside; take --from walls, corners, grid:STEP or a table");
    if (p->like.range > 0 && p->like.nearest >= p->like.range)
        return sl_fail(context, SL_BAD_ARGUMENT, "--nearest must be less than --range");
    if (p->weight && (!p->count || !p->see || p->scan_angle > 0 || p->scan_range > 0))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--weight goes with --count and --see, and with no scan of walls");
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

static sl_status add_table(sl_context *context, const camera_plan *plan, const zone_list *forbid,
                           const sl_space *space, camera_work *w) {
    sl_cameras table = {0};
    if (strcmp(plan->from, "-") != 0 && sl_path_look(plan->from) == SL_PATH_NOTHING)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--from: '%s' is no file; places are anywhere, corners, walls, walls:STEP, "
                       "grid:STEP or a table",
                       plan->from);
    SL_TRY(sl_cameras_read(context, plan->from, &plan->like, &table));
    sl_status status = SL_OK;
    for (size_t i = 0; status == SL_OK && i < table.count; i++) {
        const sl_camera *camera = &table.items[i];
        status = input_check_place(context, plan->from, camera->line, space, camera->view.at);
        if (status != SL_OK) break;
        if (zones_hold(forbid, camera->view.at))
            w->forbidden++;
        else
            status = add_place(context, plan, camera, plan->headings > 0, w);
    }
    sl_cameras_destroy(context, &table);
    return status;
}

/// How far apart places along walls are by default: a third of the range, but not more than a
/// twentieth of the side of a square as large as the inside.
static double usual_step(const camera_plan *plan, const sl_space *space) {
    double area = 0;
    for (uint32_t c = 0; c < space->cell_count; c++)
        if (space->cells[c].inside) area += sl_space_area(space, c);
    const double step = sqrt(area) / 20;
    return plan->like.range > 0 ? fmin(step, plan->like.range / 3) : step;
}

static sl_status add_points(sl_context *context, const camera_plan *plan, const zone_list *forbid,
                            const sl_space *space, sl_query *query, camera_work *w) {
    const char *from = plan->from ? plan->from : "walls";
    double step = 0;
    bool corners, walls = false, grid = false;
    SL_TRY(read_step(context, from, "corners", &step, &corners));
    if (!corners) SL_TRY(read_step(context, from, "walls", &step, &walls));
    if (!corners && !walls) SL_TRY(read_step(context, from, "grid", &step, &grid));
    if (!corners && !walls && !grid) return add_table(context, plan, forbid, space, w);
    if (grid && !(step > 0))
        return sl_fail(context, SL_BAD_ARGUMENT, "--from grid: give the step, as grid:0.5");
    if (walls && !(step > 0)) step = usual_step(plan, space);
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

static sl_status add_fixed(sl_context *context, const camera_plan *plan, const sl_space *space,
                           camera_work *w) {
    SL_TRY(sl_cameras_read(context, plan->fixed, &plan->like, &w->places));
    w->task.fixed_count = (uint32_t)w->places.count;
    w->fixed = sl_alloc_array(context, w->places.count, sizeof *w->fixed);
    if (!w->fixed) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < w->task.fixed_count; i++) {
        const sl_camera *camera = &w->places.items[i];
        w->fixed[i] = i;
        SL_TRY(input_check_place(context, plan->fixed, camera->line, space, camera->view.at));
    }
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
    return found ? SL_OK
                 : sl_fail(context, SL_BAD_ARGUMENT, "--weight: --see has no zone '%s'", name);
}

static sl_status make_weights(sl_context *context, const camera_plan *plan, camera_work *w) {
    const size_t count = w->see.ends.count;
    w->zones = sl_alloc_array(context, count, sizeof *w->zones);
    w->zone_ends = sl_alloc_array(context, count, sizeof *w->zone_ends);
    w->weights = sl_alloc_array(context, count, sizeof *w->weights);
    if (!w->zones || !w->zone_ends || !w->weights) return SL_NO_MEMORY;
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
    return SL_OK;
}

sl_status camera_work_prepare(sl_context *context, const camera_plan *plan,
                              const input_options *input, const sl_baked *baked, sl_query *query,
                              camera_work *w) {
    const sl_space *space = &baked->space;
    zone_list forbid = {0};
    if (plan->see) {
        SL_TRY(zones_read(context, "see", plan->see, input, &baked->map, &w->see));
        w->shape = zones_shape(&w->see);
        w->task.see = &w->shape;
        if (plan->weight) SL_TRY(make_weights(context, plan, w));
    }
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

// --- words

static bool has_costs(const camera_work *w) {
    for (uint32_t i = 1; i < w->task.place_count; i++)
        if (w->costs[i] != w->costs[0]) return true;
    return w->scale * 1.0 != w->costs[0];
}

static bool scans(const camera_work *w) {
    return w->task.scan_angle > 0 || w->task.scan_range > 0;
}

/// "of these 96 places", "of these 96 places and headings at 12 points"
static void say_among(const camera_work *w, char *text, size_t size) {
    const unsigned places = (unsigned)w->task.place_count;
    const size_t points = w->points + w->task.fixed_count;
    if (points == places)
        snprintf(text, size, "of these %u place%s", places, places == 1 ? "" : "s");
    else
        snprintf(text, size, "of these %u places and headings at %zu point%s", places, points,
                 points == 1 ? "" : "s");
}

static void say_fewest(const camera_work *w, const char *among, bool stopped, char *text,
                       size_t size) {
    const sl_area_placement *p = &w->placed;
    const bool costs = has_costs(w);
    char points[64];
    snprintf(points, sizeof points, "%u points %s%s", (unsigned)p->witness_count,
             scans(w) ? "on walls" : "inside", w->task.network ? " and a network" : "");
    char lower[64];
    const double least = (double)p->lower / w->scale;
    snprintf(lower, sizeof lower, "%s%.10g%s", costs ? "a cost of " : "", least,
             costs        ? ""
             : least == 1 ? " viewpoint"
                          : " viewpoints");
    if (p->lower == p->upper)
        snprintf(text, size, "No %s can, %s: %s need %s.", costs ? "cheaper choice" : "fewer",
                 among, points, lower);
    else
        snprintf(text, size, "%s need at least %s, %s: a gap of %.2g %%.%s", points, lower, among,
                 100.0 * (double)(p->upper - p->lower) / (double)p->upper,
                 stopped ? " Stopped early: more time may close it." : "");
}

void camera_work_say(const camera_work *w, bool stopped, char *text, size_t size) {
    const sl_area_placement *p = &w->placed;
    char among[128];
    int used = 0;
    if (scans(w))
        used = snprintf(text, size, "Of walls %.4g long, they scan %.4g. ", p->area, p->seen);
    else if (w->weights)
        used = snprintf(text, size,
                        "By their weights, the zones are worth %.4g, and what is seen %.4g. ",
                        p->area, p->seen);
    else if (w->task.see)
        used = snprintf(text, size, "Of the %.4g that must be seen, they see %.4g. ", p->area,
                        p->seen);
    text += used;
    size -= (size_t)used;
    say_among(w, among, sizeof among);
    if (!w->task.count)
        say_fewest(w, among, stopped, text, size);
    else
        snprintf(text, size, "They %s %.4g %%; no %u %s %s more than %.4g %%.%s",
                 scans(w) ? "scan" : "see", 100 * p->seen / p->area, (unsigned)w->task.count, among,
                 scans(w) ? "scan" : "see", 100 * p->seen_most / p->area,
                 stopped ? " Stopped early." : "");
    const size_t end = strlen(text);
    if (w->task.fixed_count)
        snprintf(text + end, size - end, " %u of them stand%s already.",
                 (unsigned)w->task.fixed_count, w->task.fixed_count == 1 ? "s" : "");
}

/// A cost as in the tables: a whole number where they have no decimals.
static void add_cost(json_fields *f, const char *key, const camera_work *w, uint64_t cost) {
    if (w->scale > 1)
        json_add_real(f, key, (double)cost / w->scale);
    else
        json_add_count(f, key, cost);
}

/// Whether some place has a range or a dead zone.
static bool has_circles(const camera_work *w) {
    for (uint32_t i = 0; i < w->task.place_count; i++)
        if (w->views[i].range > 0 || w->views[i].nearest > 0) return true;
    return false;
}

/// A cost as in the tables, with its noun.
static void say_cost(const camera_work *w, uint64_t cost, char *text, size_t size) {
    const double value = (double)cost / w->scale;
    if (has_costs(w))
        snprintf(text, size, "a cost of %.10g", value);
    else
        snprintf(text, size, "%.10g viewpoint%s", value, value == 1 ? "" : "s");
}

void camera_work_print_verdict(const camera_work *w, const sl_place_area_verdict *v, int digits) {
    char among[128], cost[64];
    const sl_area_placement *p = &w->placed;
    say_among(w, among, sizeof among);
    const unsigned count = (unsigned)p->count;
    const char *const often = w->task.cover > 1 ? ", as often as asked or as they can" : "";
    if (v->sees_all)
        printf("The %u viewpoints see all that is to be seen%s.\n", count,
               w->task.cover > 1 ? ", as often as asked" : "");
    else if (v->sees_as_all)
        printf("The %u viewpoints see all that any %s sees%s%s.\n", count, among, often,
               has_circles(w) ? " (from up to 99.95 percent of its range, and beyond 100.06 "
                                "percent of its dead zone)"
                              : "");
    else
        printf("The viewpoints do not see all that the others do: beside (%.*g, %.*g), place %u "
               "sees more.\n",
               digits, v->unseen.x, digits, v->unseen.y, (unsigned)v->place + 1);
    say_cost(w, v->lower, cost, sizeof cost);
    if (v->weak != UINT32_MAX)
        printf("The lower bound does not hold: witness %u demands more than the places must see.\n",
               (unsigned)v->weak + 1);
    else if (v->lower < p->lower)
        printf("The lower bound does not hold: %s is proven.\n", cost);
    else
        printf("All that %s see needs at least %s%s.\n", among + 3, cost, often);
    if (v->upper > p->upper) {
        say_cost(w, v->upper, cost, sizeof cost);
        printf("The viewpoints need %s, more than the proof says.\n", cost);
    } else if (v->sees_as_all && v->lower == v->upper) {
        printf("So no %s can do it.\n", has_costs(w) ? "cheaper choice" : "fewer");
    }
}

void camera_work_add_verdict_json(json_fields *f, const camera_work *w,
                                  const sl_place_area_verdict *v) {
    add_cost(f, "lower", w, v->lower);
    add_cost(f, "upper", w, v->upper);
    json_add_flag(f, "sees_all", v->sees_all);
    json_add_flag(f, "sees_as_all", v->sees_as_all);
    json_add_flag(f, "optimal", v->sees_as_all && v->lower == v->upper);
    json_add_count(f, "places", w->task.place_count);
}

sl_status camera_work_check_zones(sl_context *context, const camera_work *w,
                                  const camera_plan *plan, sl_query *query,
                                  const zone_cover *covers) {
    const int digits = sl_map_digits(sl_query_map(query));
    for (size_t z = 0; z < w->see.ends.count && !w->task.count && !scans(w); z++) {
        const char *name = w->see.names.items[z];
        if (!(covers[z].inside > 0))
            return sl_fail(context, SL_BAD_ARGUMENT, "--see: nothing of zone '%s' is inside", name);
        if (covers[z].seen > 0) continue;
        sl_point at = {0, 0};
        bool found = false;
        size_t end;
        const sl_shape zone = zones_shape_of(&w->see, z, &end);
        for (uint32_t i = 0; i < w->placed.blind_count && !found; i++) {
            if (!zones_shape_holds(&zone, w->placed.blind[i].at)) continue;
            SL_TRY(sl_place_nearest(context, query, &plan->like, w->placed.blind[i].at,
                                    w->task.places, w->task.place_count, &at, &found));
        }
        return found ? sl_fail(context, SL_BAD_ARGUMENT,
                               "--see: none of the places sees zone '%s'; the nearest one that "
                               "could is at %.*g,%.*g",
                               name, digits, at.x, digits, at.y)
                     : sl_fail(context, SL_BAD_ARGUMENT, "--see: none of the places sees zone '%s'",
                               name);
    }
    return SL_OK;
}

void camera_work_add_json(json_fields *f, const camera_work *w) {
    const sl_area_placement *p = &w->placed;
    const bool walls = scans(w);
    add_cost(f, "lower", w, p->lower);
    add_cost(f, "upper", w, p->upper);
    if (w->task.count) {
        json_add_flag(f, "optimal", p->seen >= p->seen_most * (1 - 1e-9));
        json_add_real(f,
                      walls        ? "scanned_length_bound"
                      : w->weights ? "seen_worth_bound"
                                   : "seen_area_bound",
                      p->seen_most);
    } else {
        json_add_flag(f, "optimal", p->lower == p->upper);
        json_add_real(f, walls ? "hidden_length" : "hidden_area", p->blind_area);
        json_add_real(f, walls ? "rounding_length" : "rounding_area", p->rounding);
    }
    json_add_count(f, "witnesses", p->witness_count);
    json_add_count(f, "rounds", p->rounds);
    json_add_count(f, "places", w->task.place_count);
    json_add_real(f,
                  walls        ? "to_scan_length"
                  : w->weights ? "to_see_worth"
                               : "to_see_area",
                  p->area);
    json_add_real(f,
                  walls        ? "scanned_length"
                  : w->weights ? "seen_worth"
                               : "to_see_seen_area",
                  p->seen);
}

/// What of walls none of the places scans.
static void print_blind_walls(const camera_work *w, int digits, const char *unit) {
    const sl_area_placement *p = &w->placed;
    const char *const gap = *unit ? " " : "";
    printf(
        "\n%.4g%s%s of walls %s of these places scan%s, whatever is chosen: %.3g %%. The longest "
        "of %u part%s has %.4g%s%s at %.*g,%.*g.\n",
        p->blind_area, gap, unit, w->task.cover > 1 ? "too few" : "none",
        w->task.cover > 1 ? "" : "s", 100 * p->blind_area / p->area, (unsigned)p->blind_count,
        p->blind_count == 1 ? "" : "s", p->blind[0].area, gap, unit, digits, p->blind[0].at.x,
        digits, p->blind[0].at.y);
}

sl_status camera_work_print_blind(sl_context *context, const camera_work *w,
                                  const camera_plan *plan, sl_query *query, const char *unit) {
    const sl_area_placement *p = &w->placed;
    const int digits = sl_map_digits(sl_query_map(query));
    const char *const squared = *unit ? "\xc2\xb2" : "", *const gap = *unit ? " " : "";
    if (!p->blind_count) return SL_OK;
    if (scans(w)) {
        print_blind_walls(w, digits, unit);
        return SL_OK;
    }
    printf(
        "\n%.4g%s%s%s of it %s of these places see%s, whatever is chosen: %.3g %%. The largest of "
        "%u part%s has %.4g%s%s%s at %.*g,%.*g.\n",
        p->blind_area, gap, unit, squared, w->task.cover > 1 ? "too few" : "none",
        w->task.cover > 1 ? "" : "s", 100 * p->blind_area / p->area, (unsigned)p->blind_count,
        p->blind_count == 1 ? "" : "s", p->blind[0].area, gap, unit, squared, digits,
        p->blind[0].at.x, digits, p->blind[0].at.y);
    sl_point at;
    bool found;
    SL_TRY(sl_place_nearest(context, query, &plan->like, p->blind[0].at, w->task.places,
                            w->task.place_count, &at, &found));
    if (found)
        printf("The nearest place that could see it: %.*g,%.*g.\n", digits, at.x, digits, at.y);
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
    sl_area_placement_destroy(context, &w->placed);
}
