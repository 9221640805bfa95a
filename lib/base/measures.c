/// The table of measures: the lists of sightline/measures.h, as rows.
#include "sightline/measures.h"

#include <stdio.h>
#include <string.h>

// --- places of values in their structures

#define INDEX_REGION(name, group, unit, meaning)  REGION_##name,
#define INDEX_GRAPH(name, group, unit, meaning)   GRAPH_##name,
#define INDEX_DEPTH(name, group, unit, meaning)   DEPTH_##name,
#define INDEX_AGENTS(name, group, unit, meaning)  AGENTS_##name,
#define INDEX_LINE(name, group, unit, meaning)    LINE_##name,
#define INDEX_SEGMENT(name, group, unit, meaning) SEGMENT_##name,
enum { SL_ISOVIST_MEASURES(INDEX_REGION) SL_RADIAL_MEASURES(INDEX_REGION) };
enum { SL_GRAPH_MEASURES(INDEX_GRAPH) SL_GRAPH_COUNTS(INDEX_GRAPH) };
enum { SL_DEPTH_MEASURES(INDEX_DEPTH) };
enum { SL_AGENT_MEASURES(INDEX_AGENTS) };
enum { SL_AXIAL_MEASURES(INDEX_LINE) };
enum { SL_SEGMENT_MEASURES(INDEX_SEGMENT) };

// --- rows

#define ROW(of, name, group, unit, meaning)                                                        \
    {#name, SL_OF_##of, SL_GROUP_##group, SL_UNIT_##unit, meaning, of##_##name},
#define OF_REGION(name, group, unit, meaning)  ROW(REGION, name, group, unit, meaning)
#define OF_GRAPH(name, group, unit, meaning)   ROW(GRAPH, name, group, unit, meaning)
#define OF_DEPTH(name, group, unit, meaning)   ROW(DEPTH, name, group, unit, meaning)
#define OF_AGENTS(name, group, unit, meaning)  ROW(AGENTS, name, group, unit, meaning)
#define OF_LINE(name, group, unit, meaning)    ROW(LINE, name, group, unit, meaning)
#define OF_SEGMENT(name, group, unit, meaning) ROW(SEGMENT, name, group, unit, meaning)
static const sl_measure isovist[] = {SL_ISOVIST_MEASURES(OF_REGION) SL_RADIAL_MEASURES(OF_REGION)};
static const sl_measure vga[] = {SL_GRAPH_MEASURES(OF_GRAPH) SL_ISOVIST_MEASURES(
    OF_REGION) SL_GRAPH_COUNTS(OF_GRAPH) SL_DEPTH_MEASURES(OF_DEPTH) SL_AGENT_MEASURES(OF_AGENTS)};
static const sl_measure axial[] = {SL_AXIAL_MEASURES(OF_LINE)};
static const sl_measure segments[] = {SL_SEGMENT_MEASURES(OF_SEGMENT)};

#define COUNT(table) (sizeof(table) / sizeof *(table))

const sl_measure *sl_measures(sl_analysis analysis, size_t *count) {
    switch (analysis) {
    case SL_ISOVIST:
        *count = COUNT(isovist);
        return isovist;
    case SL_VGA:
        *count = COUNT(vga);
        return vga;
    case SL_AXIAL:
        *count = COUNT(axial);
        return axial;
    case SL_SEGMENTS:
        *count = COUNT(segments);
        return segments;
    }
    *count = 0;
    return NULL;
}

size_t sl_measure_find(sl_analysis analysis, const char *name) {
    size_t count, k = 0;
    const sl_measure *rows = sl_measures(analysis, &count);
    while (k < count && strcmp(rows[k].name, name) != 0) k++;
    return k;
}

double sl_measure_value(const sl_measure *measure, const void *values) {
    return ((const double *)values)[measure->index];
}

const char *sl_measure_group_name(sl_measure_group group) {
    static const char *const names[] = {
        [SL_GROUP_LOCAL] = "visual",    [SL_GROUP_GLOBAL] = "visual",
        [SL_GROUP_THROUGH] = "through", [SL_GROUP_METRIC] = "metric",
        [SL_GROUP_ANGULAR] = "angular", [SL_GROUP_ISOVIST] = "isovist",
        [SL_GROUP_RADIAL] = "isovist",  [SL_GROUP_AGENTS] = "agents",
        [SL_GROUP_LINE] = "line",       [SL_GROUP_NETWORK] = "network"};
    return names[group];
}

void sl_measure_say_unit(const sl_measure *measure, const char *unit, char text[SL_UNIT_TEXT]) {
    static const char *const after[] = {[SL_UNIT_LENGTH] = "",
                                        [SL_UNIT_AREA] = "\xc2\xb2",
                                        [SL_UNIT_VOLUME] = "\xc2\xb3",
                                        [SL_UNIT_DEGREES] = "\xc2\xb0",
                                        [SL_UNIT_TURNS] = "right angles",
                                        [SL_UNIT_BITS] = "bits"};
    const bool of_map = measure->unit < SL_UNIT_DEGREES;
    const bool none = measure->unit == SL_UNIT_NONE || (of_map && !*unit);
    snprintf(text, SL_UNIT_TEXT, "%s%s", of_map && !none ? unit : "",
             none ? "" : after[measure->unit]);
}
