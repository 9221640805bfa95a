/// What is said of a choice among given places, and of its proof (place_cameras.h).
#include "studies/place_cameras.h"

#include <stdio.h>
#include <string.h>

bool camera_work_scans(const camera_work *w) {
    return w->task.scan_angle > 0 || w->task.scan_range > 0;
}

/// Whether lines are to be seen, and no area: areas are lengths then.
static bool has_only_lines(const camera_work *w) {
    return w->task.line_count && !w->task.see;
}

void camera_work_say(const camera_work *w, bool stopped, char *text, size_t size) {
    sl_area_placement_say(&w->task, &w->placed, w->scale, stopped, text, size);
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

void camera_work_print_verdict(const camera_work *w, const sl_place_area_verdict *v, int digits) {
    char among[128], cost[64];
    const sl_area_placement *p = &w->placed;
    sl_place_area_say_among(&w->task, among, sizeof among);
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
    sl_place_area_say_cost(&w->task, w->scale, v->lower, cost, sizeof cost);
    if (v->weak != UINT32_MAX)
        printf("The lower bound does not hold: witness %u demands more than the places must see.\n",
               (unsigned)v->weak + 1);
    else if (v->lower < p->lower)
        printf("The lower bound does not hold: %s is proven.\n", cost);
    else
        printf("All that %s see needs at least %s%s.\n", among + 3, cost, often);
    if (v->upper > p->upper) {
        sl_place_area_say_cost(&w->task, w->scale, v->upper, cost, sizeof cost);
        printf("The viewpoints need %s, more than the proof says.\n", cost);
    } else if (v->sees_as_all && v->lower == v->upper) {
        printf("So no %s can do it.\n",
               strncmp(cost, "a cost", 6) == 0 ? "cheaper choice" : "fewer");
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

void camera_work_add_json(json_fields *f, const camera_work *w) {
    const sl_area_placement *p = &w->placed;
    const bool walls = camera_work_scans(w), lines = has_only_lines(w);
    add_cost(f, "lower", w, p->lower);
    add_cost(f, "upper", w, p->upper);
    if (w->task.count) {
        json_add_flag(f, "optimal", p->seen == p->seen_most);
        json_add_real(f,
                      walls        ? "scanned_length_bound"
                      : w->weights ? "seen_worth_bound"
                      : lines      ? "seen_length_bound"
                                   : "seen_area_bound",
                      p->seen_most);
    } else {
        json_add_flag(f, "optimal", p->lower == p->upper);
        json_add_real(f, walls || lines ? "hidden_length" : "hidden_area", p->blind_area);
        json_add_real(f, walls || lines ? "rounding_length" : "rounding_area", p->rounding);
    }
    json_add_count(f, "witnesses", p->witness_count);
    json_add_count(f, "rounds", p->rounds);
    json_add_count(f, "places", w->task.place_count);
    json_add_real(f,
                  walls        ? "to_scan_length"
                  : w->weights ? "to_see_worth"
                  : lines      ? "to_see_length"
                               : "to_see_area",
                  p->area);
    json_add_real(f,
                  walls        ? "scanned_length"
                  : w->weights ? "seen_worth"
                  : lines      ? "to_see_seen_length"
                               : "to_see_seen_area",
                  p->seen);
}

/// What of walls none of the places scans, or of lines none sees.
static void print_blind_lengths(const camera_work *w, int digits, const char *unit) {
    const sl_area_placement *p = &w->placed;
    const char *const gap = *unit ? " " : "";
    const bool walls = camera_work_scans(w);
    printf("\n%.4g%s%s of %s %s of these places %s%s, whatever is chosen: %.3g %%. The longest "
           "of %u part%s has %.4g%s%s at %.*g,%.*g.\n",
           p->blind_area, gap, unit, walls ? "walls" : "lines",
           w->task.cover > 1 ? "too few" : "none", walls ? "scan" : "see",
           w->task.cover > 1 ? "" : "s", 100 * p->blind_area / p->area, (unsigned)p->blind_count,
           p->blind_count == 1 ? "" : "s", p->blind[0].area, gap, unit, digits, p->blind[0].at.x,
           digits, p->blind[0].at.y);
}

static void print_blind_area(const camera_work *w, int digits, const char *unit) {
    const sl_area_placement *p = &w->placed;
    const char *const squared = *unit ? "\xc2\xb2" : "", *const gap = *unit ? " " : "";
    printf(
        "\n%.4g%s%s%s of it %s of these places see%s, whatever is chosen: %.3g %%. The largest of "
        "%u part%s has %.4g%s%s%s at %.*g,%.*g.\n",
        p->blind_area, gap, unit, squared, w->task.cover > 1 ? "too few" : "none",
        w->task.cover > 1 ? "" : "s", 100 * p->blind_area / p->area, (unsigned)p->blind_count,
        p->blind_count == 1 ? "" : "s", p->blind[0].area, gap, unit, squared, digits,
        p->blind[0].at.x, digits, p->blind[0].at.y);
}

sl_status camera_work_print_blind(sl_context *context, const camera_work *w,
                                  const camera_plan *plan, sl_query *query, const char *unit) {
    const sl_area_placement *p = &w->placed;
    const int digits = sl_map_digits(sl_query_map(query));
    if (!p->blind_count) return SL_OK;
    if (camera_work_scans(w) || has_only_lines(w))
        print_blind_lengths(w, digits, unit);
    else
        print_blind_area(w, digits, unit);
    if (camera_work_scans(w)) return SL_OK;
    sl_point at;
    bool found;
    SL_TRY(sl_place_nearest(context, query, &plan->like, p->blind[0].at, w->task.places,
                            w->task.place_count, &at, &found));
    if (found)
        printf("The nearest place that could see it: %.*g,%.*g.\n", digits, at.x, digits, at.y);
    return SL_OK;
}
