/// What is proven of a choice among given places, in a sentence or two (place_area.h).
#include "sightline/place_area.h"

#include <stdio.h>
#include <string.h>

static bool scans(const sl_place_area *task) {
    return task->scan_angle > 0 || task->scan_range > 0;
}

static bool has_costs(const sl_place_area *task, double scale) {
    for (uint32_t i = 1; task->costs && i < task->place_count; i++)
        if (task->costs[i] != task->costs[0]) return true;
    return task->costs && task->place_count && task->costs[0] != scale;
}

static uint32_t count_points(const sl_place_area *task) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < task->place_count; i++) {
        const sl_point at = task->places[i].at;
        const bool again = i > task->fixed_count && task->places[i - 1].at.x == at.x &&
                           task->places[i - 1].at.y == at.y;
        count += !again;
    }
    return count;
}

void sl_place_area_say_among(const sl_place_area *task, char *text, size_t size) {
    const unsigned places = (unsigned)task->place_count, points = (unsigned)count_points(task);
    if (places == 1)
        snprintf(text, size, "of this place");
    else if (points == places)
        snprintf(text, size, "of these %u places", places);
    else
        snprintf(text, size, "of these %u places and headings at %u point%s", places, points,
                 points == 1 ? "" : "s");
}

void sl_place_area_say_cost(const sl_place_area *task, double scale, uint64_t cost, char *text,
                            size_t size) {
    const double value = (double)cost / scale;
    if (has_costs(task, scale))
        snprintf(text, size, "a cost of %.10g", value);
    else
        snprintf(text, size, "%.10g viewpoint%s", value, value == 1 ? "" : "s");
}

static void say_fewest(const sl_place_area *task, const sl_area_placement *p, double scale,
                       bool stopped, const char *among, char *text, size_t size) {
    char points[64], lower[64];
    const bool one = p->witness_count == 1 && !task->network;
    snprintf(points, sizeof points, "%u point%s %s%s", (unsigned)p->witness_count,
             p->witness_count == 1 ? "" : "s", scans(task) ? "on walls" : "inside",
             task->network ? " and a network" : "");
    sl_place_area_say_cost(task, scale, p->lower, lower, sizeof lower);
    if (p->lower == p->upper)
        snprintf(text, size, "No %s can, %s: %s need%s %s.",
                 has_costs(task, scale) ? "cheaper choice" : "fewer", among, points, one ? "s" : "",
                 lower);
    else
        snprintf(text, size, "%s need%s at least %s, %s: a gap of %.2g %%.%s", points,
                 one ? "s" : "", lower, among,
                 100.0 * (double)(p->upper - p->lower) / (double)p->upper,
                 stopped ? " Stopped early: more time may close it." : "");
}

/// The most that some viewpoints see, of which fixed ones are a part.
static void say_most(const sl_place_area *task, const sl_area_placement *p, bool stopped,
                     const char *among, char *text, size_t size) {
    const char *const verb = scans(task) ? "scan" : "see";
    const unsigned fixed = task->fixed_count, more = task->count;
    char with[64] = "", number[32];
    if (fixed)
        snprintf(with, sizeof with, "with the %u that stand%s already, ", fixed,
                 fixed == 1 ? "s" : "");
    snprintf(number, sizeof number, fixed ? "%u more" : "%u", more);
    snprintf(text, size, "%s %s%s %.4g %%; %sno %s %s %s%s more than %.4g %%.%s",
             p->count == 1 ? "It" : "They", verb, p->count == 1 ? "s" : "", 100 * p->seen / p->area,
             with, number, among, verb, more == 1 ? "s" : "", 100 * p->seen_most / p->area,
             stopped ? " Stopped early." : "");
}

/// What of what is to be seen is seen; where all of the inside is, nothing. Returns its length.
static size_t say_seen(const sl_place_area *task, const sl_area_placement *p, char *text,
                       size_t size) {
    int used = 0;
    if (scans(task))
        used = snprintf(text, size, "Of walls %.4g long, they scan %.4g. ", p->area, p->seen);
    else if (task->weights || task->line_weights)
        used =
            snprintf(text, size, "By their weights, the %s are worth %.4g, and what is seen %.4g. ",
                     task->see ? "zones" : "lines", p->area, p->seen);
    else if (task->line_count && !task->see)
        used = snprintf(text, size, "Of lines %.4g long, they see %.4g. ", p->area, p->seen);
    else if (task->see)
        used = snprintf(text, size, "Of the %.4g that must be seen, they see %.4g. ", p->area,
                        p->seen);
    return (size_t)used < size ? (size_t)used : size;
}

void sl_area_placement_say(const sl_place_area *task, const sl_area_placement *p, double scale,
                           bool stopped, char *text, size_t size) {
    char among[128];
    const size_t used = say_seen(task, p, text, size);
    text += used;
    size -= used;
    sl_place_area_say_among(task, among, sizeof among);
    if (!task->count)
        say_fewest(task, p, scale, stopped, among, text, size);
    else
        say_most(task, p, stopped, among, text, size);
    const size_t end = strlen(text);
    if (task->fixed_count && !task->count)
        snprintf(text + end, size - end, " %u of them stand%s already.",
                 (unsigned)task->fixed_count, task->fixed_count == 1 ? "s" : "");
}
