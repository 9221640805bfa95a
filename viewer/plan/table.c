/// Each tool has a row of functions that give its values; sorting, choosing and writing know
/// nothing of tools.
#include "plan/table.h"

#include "plan/compare.h"
#include "plan/from_line.h"
#include "plan/heat.h"
#include "plan/line_map.h"
#include "plan/room_map.h"
#include "plan/route.h"
#include "sightline/support.h"
#include "ui/tones.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static sl_segment at_point(sl_point p) {
    return (sl_segment){p, p};
}

static uint32_t no_stamp(const view_state *view) {
    return view->present.version;
}

static double of_point(sl_point p, size_t column) {
    return column ? p.y : p.x;
}

// --- the visibility graph: the columns of `sightline vga` that are measured

static const heat_graph *graph_of(const view_state *view) {
    const heat_graph *graph = NULL;
    return heat_layer_values(view, &graph) ? graph : NULL;
}

/// The measure of a column from the third on; NULL: there are no more.
static const sl_measure *graph_measure(const view_state *view, size_t column) {
    size_t count;
    const sl_measure *all = sl_measures(SL_VGA, &count);
    const heat_graph *graph = graph_of(view);
    size_t left = column - 2;
    for (size_t k = 0; graph && k < count; k++)
        if (heat_measure_part(&all[k]) & graph->parts && left-- == 0) return &all[k];
    return NULL;
}

static size_t graph_rows(const view_state *view) {
    return graph_of(view)->grid.count;
}

/// The last column says parts, where there are several.
static size_t graph_columns(const view_state *view) {
    size_t count = 2;
    while (graph_measure(view, count)) count++;
    return count + (heat_layer_part(view, 0) > 0);
}

static void graph_name(const view_state *view, size_t column, char text[TABLE_NAME]) {
    const sl_measure *measure = column > 1 ? graph_measure(view, column) : NULL;
    snprintf(text, TABLE_NAME, "%s",
             measure       ? measure->name
             : column == 0 ? "x"
             : column == 1 ? "y"
                           : "part");
}

static double graph_value(const view_state *view, size_t row, size_t column) {
    const heat_graph *graph = graph_of(view);
    if (column < 2) return of_point(graph->grid.points[row], column);
    const sl_measure *measure = graph_measure(view, column);
    return measure ? sl_measure_value(measure, &graph->measures[row])
                   : heat_layer_part(view, (uint32_t)row);
}

static sl_segment graph_place(const view_state *view, size_t row) {
    return at_point(graph_of(view)->grid.points[row]);
}

static uint32_t graph_stamp(const view_state *view) {
    return view->heat_choice.stamp;
}

// --- changes: the measure in this plan, in the other one, and what it gains

static size_t five(const view_state *view) {
    (void)view;
    return 5;
}

static void change_name(const view_state *view, size_t column, char text[TABLE_NAME]) {
    static const char *const endings[] = {"", "_other", "_change"};
    if (column < 2)
        snprintf(text, TABLE_NAME, "%s", column ? "y" : "x");
    else
        snprintf(text, TABLE_NAME, "%.50s%s", heat_measure(view->heat_choice.measure)->name,
                 endings[column - 2]);
}

static double change_value(const view_state *view, size_t row, size_t column) {
    const sl_measure *measure = heat_measure(view->heat_choice.measure);
    const heat_graph *graph, *other = compare_graph(view, heat_measure_part(measure));
    const double *changes = heat_layer_values(view, &graph);
    const sl_point at = graph->grid.points[row];
    if (column < 2) return of_point(at, column);
    if (column == 2) return sl_measure_value(measure, &graph->measures[row]);
    const uint32_t p = other ? heat_graph_square(other, at) : UINT32_MAX;
    if (column == 3) return p == UINT32_MAX ? NAN : sl_measure_value(measure, &other->measures[p]);
    return changes[row];
}

// --- axial lines and segments

static size_t line_rows(const view_state *view) {
    return line_map_shown(view)->count;
}

static size_t line_columns(const view_state *view) {
    size_t count;
    line_map_measures(line_map_shown(view), &count);
    return 4 + count;
}

static void line_name(const view_state *view, size_t column, char text[TABLE_NAME]) {
    static const char *const ends[] = {"x1", "y1", "x2", "y2"};
    size_t count;
    snprintf(text, TABLE_NAME, "%s",
             column < 4 ? ends[column]
                        : line_map_measures(line_map_shown(view), &count)[column - 4].name);
}

static double line_value(const view_state *view, size_t row, size_t column) {
    const line_map *map = line_map_shown(view);
    if (column < 4) return of_point(column < 2 ? map->lines[row].a : map->lines[row].b, column % 2);
    return line_map_value(map, column - 4, (uint32_t)row);
}

/// Lines of the plan and those of the drawing.
static uint32_t line_stamp(const view_state *view) {
    return 2 * view->present.version + line_map_shown(view)->drawn;
}

static sl_segment line_place(const view_state *view, size_t row) {
    return line_map_shown(view)->lines[row];
}

// --- the path: its corners, and how far they are along it

static size_t route_rows(const view_state *view) {
    return view->route->route.count;
}

static size_t three(const view_state *view) {
    (void)view;
    return 3;
}

static void route_name(const view_state *view, size_t column, char text[TABLE_NAME]) {
    static const char *const names[] = {"x", "y", "length"};
    (void)view;
    snprintf(text, TABLE_NAME, "%s", names[column]);
}

static double route_value(const view_state *view, size_t row, size_t column) {
    const sl_point *p = view->route->route.points;
    double length = 0;
    if (column < 2) return of_point(p[row], column);
    for (size_t i = 1; i <= row; i++) length += hypot(p[i].x - p[i - 1].x, p[i].y - p[i - 1].y);
    return length;
}

static sl_segment route_place(const view_state *view, size_t row) {
    return at_point(view->route->route.points[row]);
}

// --- from a line: from some point, and from all

static size_t two(const view_state *view) {
    (void)view;
    return 2;
}

static void from_line_name(const view_state *view, size_t column, char text[TABLE_NAME]) {
    static const char *const names[] = {"from_all", "area", "corners"};
    (void)view;
    snprintf(text, TABLE_NAME, "%s", names[column]);
}

static double from_line_value(const view_state *view, size_t row, size_t column) {
    const sl_set_region *region = &from_line_seen(view)->seen[row];
    const sl_shape *s = &region->shape;
    if (column == 0) return (double)row;
    return column == 1 ? region->area : s->count ? (double)s->ends[s->count - 1] : 0;
}

static sl_segment from_line_place(const view_state *view, size_t row) {
    (void)row;
    return (sl_segment){view->from_line->ends[0], view->from_line->ends[1]};
}

// --- rooms and zones

static size_t room_rows(const view_state *view) {
    return room_map_rows(room_map_shown(view));
}

typedef enum room_column {
    ROOM_TEXT,
    ROOM_AREA,
    ROOM_MEAN,
    ROOM_POINTS,
    ROOM_SEEN,
    ROOM_SHARE
} room_column;

/// The columns of the heat map are there where it is shown.
static bool room_has_means(const view_state *view) {
    const heat_graph *graph;
    return heat_layer_values(view, &graph) != NULL;
}

static size_t room_columns(const view_state *view) {
    return room_has_means(view) ? 6 : 4;
}

static room_column room_column_of(const view_state *view, size_t column) {
    return (room_column)(column > ROOM_AREA && !room_has_means(view) ? column + 2 : column);
}

static void room_column_name(const view_state *view, size_t column, char text[TABLE_NAME]) {
    static const char *const names[] = {
        [ROOM_TEXT] = "name",     [ROOM_AREA] = "area",      [ROOM_MEAN] = "mean",
        [ROOM_POINTS] = "points", [ROOM_SEEN] = "seen_area", [ROOM_SHARE] = "seen_share"};
    const room_column which = room_column_of(view, column);
    snprintf(text, TABLE_NAME, "%s", names[which]);
    if (which == ROOM_MEAN)
        snprintf(text, TABLE_NAME, "mean_%.40s%s", heat_measure(view->heat_choice.measure)->name,
                 heat_layer_changes(view) ? "_change" : "");
}

static const char *room_text(const view_state *view, size_t row) {
    return room_map_name(room_map_shown(view), row);
}

/// How many rows have a name that comes before.
static double room_rank(const view_state *view, size_t row) {
    size_t before = 0;
    for (size_t i = 0; i < room_rows(view); i++)
        before += strcmp(room_text(view, i), room_text(view, row)) < 0;
    return (double)before;
}

static double room_value(const view_state *view, size_t row, size_t column) {
    const room_map *map = room_map_shown(view);
    const double area = room_map_area(map, row);
    switch (room_column_of(view, column)) {
    case ROOM_TEXT:
        return room_rank(view, row);
    case ROOM_AREA:
        return area;
    case ROOM_MEAN:
        return map->means[row];
    case ROOM_POINTS:
        return map->points[row];
    case ROOM_SEEN:
        return map->seen[row];
    default:
        return area > 0 ? map->seen[row] / area : NAN;
    }
}

static sl_segment room_place(const view_state *view, size_t row) {
    return at_point(room_map_place(room_map_shown(view), row));
}

static uint32_t room_stamp(const view_state *view) {
    return room_map_shown(view)->zone_stamp;
}

// --- the isovist: one row

static size_t one(const view_state *view) {
    (void)view;
    return 1;
}

static size_t isovist_columns(const view_state *view) {
    size_t count;
    (void)view;
    sl_measures(SL_ISOVIST, &count);
    return 2 + count;
}

static void isovist_name(const view_state *view, size_t column, char text[TABLE_NAME]) {
    size_t count;
    (void)view;
    snprintf(text, TABLE_NAME, "%s",
             column == 0   ? "x"
             : column == 1 ? "y"
                           : sl_measures(SL_ISOVIST, &count)[column - 2].name);
}

static double isovist_value(const view_state *view, size_t row, size_t column) {
    size_t count;
    (void)row;
    if (column < 2) return of_point(view->eye.at, column);
    const sl_region_measures all = sl_region_measure(&view->seen.region);
    return sl_measure_value(&sl_measures(SL_ISOVIST, &count)[column - 2], &all);
}

static sl_segment isovist_place(const view_state *view, size_t row) {
    (void)row;
    return at_point(view->eye.at);
}

// --- which one

const table_source *table_source_now(const view_state *view) {
    static const table_source graph = {"point",     graph_rows,  graph_columns, graph_name,
                                       graph_value, graph_place, graph_stamp,   NULL};
    static const table_source changes = {"place",      graph_rows,  five,        change_name,
                                         change_value, graph_place, graph_stamp, NULL};
    static const table_source axial = {"line",     line_rows,  line_columns, line_name,
                                       line_value, line_place, line_stamp,   NULL};
    static const table_source segments = {"segment",  line_rows,  line_columns, line_name,
                                          line_value, line_place, line_stamp,   NULL};
    static const table_source route = {"corner",    route_rows,  three,    route_name,
                                       route_value, route_place, no_stamp, NULL};
    static const table_source areas = {
        "area", two, three, from_line_name, from_line_value, from_line_place, no_stamp, NULL};
    static const table_source isovist = {"isovist",    one,           isovist_columns,
                                         isovist_name, isovist_value, isovist_place,
                                         no_stamp,     NULL};
    static const table_source rooms = {"room",     room_rows,  room_columns, room_column_name,
                                       room_value, room_place, room_stamp,   room_text};
    if (view->mode != MODE_PLAN || !view->document->baked) return NULL;
    switch (view->tool) {
    case TOOL_ROOMS:
        return room_map_shown(view) ? &rooms : NULL;
    case TOOL_AXIAL:
        return line_map_shown(view) ? &axial : NULL;
    case TOOL_SEGMENTS:
        return line_map_shown(view) ? &segments : NULL;
    case TOOL_PATH:
        return view->route && view->route->clicks == 2 && view->route->route.found ? &route : NULL;
    case TOOL_FROM_LINE:
        return from_line_seen(view) ? &areas : NULL;
    default:
        if (!graph_of(view)) return view->seen.valid ? &isovist : NULL;
        return heat_layer_changes(view) ? &changes : &graph;
    }
}

// --- the order

typedef struct sort_key {
    double value;
    size_t row;
} sort_key;

/// Rows without a value come last, both ways. Those of one value stay as they come.
static int compare_keys(const sort_key *p, const sort_key *q, bool down) {
    if (isnan(p->value) != isnan(q->value)) return isnan(p->value) ? 1 : -1;
    if (p->value != q->value && !isnan(p->value)) return (p->value > q->value) != down ? 1 : -1;
    return (p->row > q->row) - (p->row < q->row);
}

static int compare_up(const void *a, const void *b) {
    return compare_keys(a, b, false);
}

static int compare_down(const void *a, const void *b) {
    return compare_keys(a, b, true);
}

static sl_status put_in_order(view_state *view) {
    table_state *t = &view->table;
    sl_free(view->context, t->order);
    t->order = NULL;
    if (!t->sorted) return SL_OK;
    sort_key *keys = sl_alloc_array(view->context, t->rows + 1, sizeof *keys);
    t->order = sl_alloc_array(view->context, t->rows + 1, sizeof *t->order);
    if (!keys || !t->order) {
        sl_free(view->context, keys);
        return SL_NO_MEMORY;
    }
    for (size_t i = 0; i < t->rows; i++) keys[i] = (sort_key){t->of->value(view, i, t->column), i};
    qsort(keys, t->rows, sizeof *keys, t->down ? compare_down : compare_up);
    for (size_t i = 0; i < t->rows; i++) t->order[i] = keys[i].row;
    sl_free(view->context, keys);
    return SL_OK;
}

void table_destroy(sl_context *context, table_state *table) {
    sl_free(context, table->order);
    *table = (table_state){.chosen = SIZE_MAX};
}

/// Short tables are sorted in each frame: a path has another length without another stamp.
#define ALWAYS_SORTED 1000

/// Another tool's table begins as its rows come; new values of the same keep the column.
void table_update(view_state *view) {
    table_state *t = &view->table;
    const table_source *of = table_source_now(view);
    if (of != t->of) table_destroy(view->context, t);
    t->of = of;
    if (!of) return;
    const size_t rows = of->rows(view);
    const uint32_t stamp = of->stamp(view);
    const bool same = rows == t->rows && stamp == t->stamp;
    if (same && (!t->sorted || rows > ALWAYS_SORTED)) return;
    if (rows != t->rows || t->chosen >= rows) t->chosen = SIZE_MAX;
    t->rows = rows;
    t->stamp = stamp;
    if (t->column >= of->columns(view)) t->sorted = false;
    view_check(view, put_in_order(view));
}

size_t table_row(const table_state *table, size_t place) {
    return table->order ? table->order[place] : place;
}

void table_sort(view_state *view, size_t column) {
    table_state *t = &view->table;
    if (!t->of || column >= t->of->columns(view)) return;
    const bool same = t->sorted && t->column == column;
    t->sorted = !same || t->down;
    t->down = !same;
    t->column = column;
    t->reveal = true;
    view_check(view, put_in_order(view));
}

void table_shift(view_state *view, int by) {
    table_state *t = &view->table;
    if (!t->of) return;
    const size_t columns = t->of->columns(view);
    if (by > 0 && t->first_column + 1 < columns) t->first_column++;
    if (by < 0 && t->first_column > 0) t->first_column--;
}

// --- the choice

static bool is_in_sight(const view_state *view, sl_point at) {
    const sl_frame frame = camera_frame(&view->camera, view->plan[0], 1);
    return box_has(view->plan[0], sl_frame_point(&frame, at));
}

void table_choose(view_state *view, size_t row) {
    table_state *t = &view->table;
    t->chosen = t->of && row < t->rows ? row : SIZE_MAX;
    t->reveal = true;
    if (line_map_shown(view))
        line_map_pick(view, t->chosen == SIZE_MAX ? UINT32_MAX : (uint32_t)t->chosen);
    if (t->chosen == SIZE_MAX) return;
    const sl_segment s = t->of->place(view, row);
    const sl_point middle = {s.a.x / 2 + s.b.x / 2, s.a.y / 2 + s.b.y / 2};
    if (is_in_sight(view, middle)) return;
    view_pan(view, 0, 0);
    view->camera.middle = middle;
}

void table_step(view_state *view, int by) {
    const table_state *t = &view->table;
    size_t place = 0;
    if (!t->of || !t->rows) return;
    while (place < t->rows && table_row(t, place) != t->chosen) place++;
    if (place == t->rows)
        place = by > 0 ? 0 : t->rows - 1;
    else
        place = (place + t->rows + (size_t)by) % t->rows;
    table_choose(view, table_row(t, place));
}

void table_pick(view_state *view, sl_point at) {
    table_update(view);
    const table_state *t = &view->table;
    const heat_graph *graph = graph_of(view);
    uint32_t row = UINT32_MAX;
    if (room_map_shown(view)) {
        table_choose(view, room_map_at(room_map_shown(view), at));
        return;
    }
    if (line_map_shown(view))
        row = line_map_at(view, at);
    else if (t->of && graph && t->of->rows == graph_rows)
        row = heat_graph_square(graph, at);
    else
        return;
    table_choose(view, row == UINT32_MAX ? SIZE_MAX : row);
}

void table_draw_chosen(const view_state *view, const sl_frame *frame) {
    const table_state *t = &view->table;
    if (!t->of || t->of != table_source_now(view) || t->chosen >= t->of->rows(view)) return;
    const sl_segment s = t->of->place(view, t->chosen);
    if (t->of->text) return; // it is drawn as a whole
    if (s.a.x == s.b.x && s.a.y == s.b.y) {
        sl_draw_ring(view->ui->cairo, frame, s.a, 9 * frame->unit, view->ui->palette.ink,
                     2.2 * frame->unit);
        return;
    }
    cairo_new_path(view->ui->cairo);
    sl_path_segment(view->ui->cairo, frame, s.a, s.b);
    tone_cased(view->ui->cairo, &view->ui->palette, view->ui->palette.start, 4 * frame->unit, 0);
}

// --- the file

static sl_status put_rows(view_state *view, FILE *out) {
    const table_state *t = &view->table;
    const size_t columns = t->of->columns(view);
    char name[TABLE_NAME];
    for (size_t k = 0; k < columns; k++) {
        t->of->name(view, k, name);
        fprintf(out, "%s%c", name, k + 1 < columns ? ',' : '\n');
    }
    for (size_t i = 0; i < t->rows; i++) {
        for (size_t k = 0; k < columns; k++) {
            const double value = t->of->value(view, table_row(t, i), k);
            char text[SL_NUMBER_TEXT] = "";
            if (t->of->text && k == 0) {
                sl_table_text_write(out, t->of->text(view, table_row(t, i)), false);
                fputc(',', out);
                continue;
            }
            if (!isnan(value)) sl_number_write(value, text);
            fprintf(out, "%s%c", text, k + 1 < columns ? ',' : '\n');
        }
    }
    return SL_OK;
}

sl_status table_write(view_state *view, const char *path) {
    sl_output output;
    table_update(view);
    if (!view->table.of)
        return sl_fail(view->context, SL_BAD_ARGUMENT, "this tool has no table to be written yet");
    SL_TRY(sl_output_open(view->context, path, &output));
    SL_TRY(sl_output_close(view->context, &output, put_rows(view, output.stream)));
    ui_say(view->ui, false, "%zu %s%s written to %s", view->table.rows, view->table.of->noun,
           view->table.rows == 1 ? "" : "s", path);
    return SL_OK;
}
