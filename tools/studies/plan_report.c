/// What a report says of a plan. Every figure is computed from the map that is read.
#include "studies/plan_report.h"

#include "reports/fields.h"
#include "sightline/axial.h"
#include "sightline/support.h"
#include "sightline/version.h"
#include "studies/room_table.h"
#include "system/built.h"

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/// Beyond so many walls, axial lines take minutes.
enum { AXIAL_WALLS = 2000 };

enum { TEXT = 1024 };

typedef SL_ARRAY(const char *) text_list;

typedef struct axial_part {
    sl_axial_lines lines;
    sl_line_graph graph;
    sl_axial_measures *measures;
    double *values; ///< integration, by line
    sl_drawn_lines drawn;
} axial_part;

/// A report that is being put together. The blocks refer to what it keeps.
typedef struct report {
    sl_context *context;
    const plan_report_plan *plan;
    vga_work w;
    axial_part axial;
    room_table rooms;
    sl_plan_label *labels; ///< names of rooms
    SL_ARRAY(sl_document_block) blocks;
    SL_ARRAY(char *) texts;         ///< that blocks have
    SL_ARRAY(vga_field *) fields;   ///< likewise
    SL_ARRAY(const char **) tables; ///< likewise
    sl_status status;               ///< the first failure; what is added after it is dropped
} report;

// --- blocks

static void keep_status(report *r, sl_status status) {
    if (r->status == SL_OK) r->status = status;
}

/// A copy that the report keeps; "" after a failure.
static const char *keep(report *r, const char *text) {
    char *copy = sl_copy_text(r->context, text, strlen(text));
    keep_status(r, copy ? SL_ARRAY_ROOM(r->context, &r->texts, 1) : SL_NO_MEMORY);
    if (r->status != SL_OK) {
        sl_free(r->context, copy);
        return "";
    }
    return r->texts.items[r->texts.count++] = copy;
}

__attribute__((format(printf, 2, 3))) static const char *say(report *r, const char *format, ...) {
    char text[TEXT];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return keep(r, text);
}

static void add(report *r, sl_document_block block) {
    if (r->status == SL_OK) keep_status(r, SL_ARRAY_ROOM(r->context, &r->blocks, 1));
    if (r->status == SL_OK) r->blocks.items[r->blocks.count++] = block;
}

static void add_text(report *r, sl_document_block_kind kind, const char *text) {
    add(r, (sl_document_block){.kind = kind, .text = text});
}

/// Adds a table of the cells in `list`, row by row, which it takes over.
static void add_table(report *r, text_list *list, size_t columns) {
    keep_status(r, SL_ARRAY_ROOM(r->context, &r->tables, 1));
    if (r->status != SL_OK) {
        sl_free(r->context, list->items);
        return;
    }
    r->tables.items[r->tables.count++] = list->items;
    add(r, (sl_document_block){.kind = SL_BLOCK_TABLE,
                               .cells = list->items,
                               .columns = columns,
                               .rows = list->count / columns});
}

static void add_cell(report *r, text_list *list, const char *text) {
    if (r->status == SL_OK) keep_status(r, SL_ARRAY_ROOM(r->context, list, 1));
    if (r->status == SL_OK) list->items[list->count++] = text;
}

static void add_row(report *r, text_list *list, const char *name, const char *value) {
    add_cell(r, list, name);
    add_cell(r, list, value);
}

/// A number with four digits, or all before the point.
static const char *number(report *r, double value) {
    if (isnan(value)) return "not defined";
    return say(r, fabs(value) >= 1000 ? "%.0f" : "%.4g", value);
}

/// Names of files may be of any bytes.
static const char *file_name(report *r) {
    char readable[256];
    const char *name = sl_path_name(r->plan->graph.input);
    text_make_readable(strcmp(name, "-") ? name : "standard input", readable, sizeof readable);
    return keep(r, readable);
}

static const char *length_unit(const report *r) {
    return r->w.baked.map.unit;
}

// --- the plan

static void add_plan(report *r) {
    const sl_map *map = &r->w.baked.map;
    const sl_space *space = &r->w.baked.space;
    const sl_box b = space->bounds;
    const char *unit = *map->unit ? map->unit : "units";
    uint32_t inside = 0;
    double area = 0, all = 0;
    size_t open = 0;
    for (uint32_t c = 0; c < space->cell_count; c++) {
        const double of_cell = sl_space_area(space, c);
        all += of_cell;
        inside += space->cells[c].inside;
        if (space->cells[c].inside) area += of_cell;
    }
    for (size_t i = 0; i < map->door_count; i++) open += map->doors[i].open;
    text_list t = {0};
    add_text(r, SL_BLOCK_HEADING, "The plan");
    add(r, (sl_document_block){.kind = SL_BLOCK_PICTURE, .baked = &r->w.baked});
    add_row(r, &t, "what", "value");
    add_row(r, &t, "file", file_name(r));
    add_row(r, &t, "unit of lengths", *map->unit ? map->unit : "the file does not say");
    add_row(r, &t, "size",
            say(r, "%s x %s %s", number(r, b.max.x - b.min.x), number(r, b.max.y - b.min.y), unit));
    add_row(r, &t, "walls after cleaning", say(r, "%" PRIu32, space->wall_count));
    if (map->door_count)
        add_row(r, &t, "doors", say(r, "%zu, %zu of them open", map->door_count, open));
    if (map->oneway_count) add_row(r, &t, "one-way glass", say(r, "%zu", map->oneway_count));
    if (map->range > 0) add_row(r, &t, "view range", say(r, "%s %s", number(r, map->range), unit));
    add_row(r, &t, "area inside",
            say(r, "%s square %s, %.1f %% of the whole", number(r, area), unit,
                all > 0 ? 100 * area / all : 0));
    add_row(r, &t, "convex cells inside", say(r, "%" PRIu32, inside));
    add_table(r, &t, 2);
}

// --- measures on the grid

/// Mean, deviation and ends of the values that are defined.
typedef struct value_summary {
    double count, mean, deviation, least, most;
} value_summary;

/// Of several parts the largest counts, where the measure goes by parts.
static bool counts(const vga_table *t, size_t measure, uint32_t p) {
    return !(t->part_count > 1 && t->part[p] && vga_measure_is_of_part(measure));
}

static value_summary summarise(const vga_table *t, size_t measure) {
    value_summary s = {.least = INFINITY, .most = -INFINITY};
    for (uint32_t p = 0; p < t->grid.count; p++) {
        const double value = counts(t, measure, p) ? vga_value(t, measure, p) : NAN;
        if (isnan(value)) continue;
        s.count++;
        s.mean += value;
        s.least = fmin(s.least, value);
        s.most = fmax(s.most, value);
    }
    s.mean /= s.count;
    for (uint32_t p = 0; p < t->grid.count; p++) {
        const double value = counts(t, measure, p) ? vga_value(t, measure, p) : NAN;
        if (!isnan(value)) s.deviation += (value - s.mean) * (value - s.mean);
    }
    s.deviation = sqrt(s.deviation / s.count);
    return s;
}

static void add_heat_map(report *r, size_t measure) {
    const sl_measure *m = &sl_measures(SL_VGA, &(size_t){0})[measure];
    char unit[SL_UNIT_TEXT], words[64];
    keep_status(r, SL_ARRAY_ROOM(r->context, &r->fields, 1));
    vga_field *field = r->status == SL_OK ? sl_alloc_array(r->context, 1, sizeof *field) : NULL;
    keep_status(r, field ? SL_OK : SL_NO_MEMORY);
    if (r->status != SL_OK) return;
    r->fields.items[r->fields.count++] = field;
    keep_status(r, vga_field_make(r->context, &r->w, measure, NULL, field));
    words_of(m->name, words, sizeof words);
    sl_measure_say_unit(m, length_unit(r), unit);
    field->field.name = keep(r, words);
    field->field.unit = *unit ? keep(r, unit) : NULL;
    add_text(r, SL_BLOCK_HEADING, field->field.name);
    add_text(r, SL_BLOCK_TEXT, say(r, "%s: %s.", field->field.name, m->meaning));
    add(r, (sl_document_block){
               .kind = SL_BLOCK_PICTURE, .baked = &r->w.baked, .field = &field->field});
}

static void add_heat_maps(report *r) {
    static const char *const usual[] = {"area", "visual_integration_hh", "connectivity",
                                        "through_vision"};
    const option_list *asked = &r->plan->measures;
    const size_t count = asked->count ? asked->count : sizeof usual / sizeof *usual;
    for (size_t i = 0; i < count; i++)
        add_heat_map(r, sl_measure_find(SL_VGA, asked->count ? asked->items[i] : usual[i]));
}

static void add_measures(report *r) {
    static const char *const head[] = {"measure", "mean", "deviation", "least",
                                       "most",    "unit", "meaning"};
    const vga_table *table = &r->w.table;
    size_t count;
    const sl_measure *measures = sl_measures(SL_VGA, &count);
    text_list t = {0};
    add_text(r, SL_BLOCK_HEADING, "Measures");
    add_text(r, SL_BLOCK_TEXT,
             say(r,
                 "%" PRIu32 " points of a grid with a step of %s %s. The names are those of "
                 "depthmapX.%s",
                 table->grid.count, number(r, table->grid.step),
                 *length_unit(r) ? length_unit(r) : "units",
                 table->part_count > 1
                     ? say(r,
                           " No sightline joins the %" PRIu32
                           " parts of the graph: measures of the graph are those of the largest "
                           "part, with %" PRIu32 " points.",
                           table->part_count, vga_part_size(table, 0))
                     : ""));
    for (size_t c = 0; c < 7; c++) add_cell(r, &t, head[c]);
    for (size_t k = 0; k < count; k++) {
        if (!(table->parts & vga_measure_part(k))) continue;
        char unit[SL_UNIT_TEXT], words[64];
        const value_summary s = summarise(table, k);
        words_of(measures[k].name, words, sizeof words);
        sl_measure_say_unit(&measures[k], length_unit(r), unit);
        add_cell(r, &t, keep(r, words));
        for (int c = 0; c < 4; c++)
            add_cell(r, &t,
                     number(r, !s.count ? NAN
                               : c == 0 ? s.mean
                               : c == 1 ? s.deviation
                               : c == 2 ? s.least
                                        : s.most));
        add_cell(r, &t, keep(r, unit));
        add_cell(r, &t, measures[k].meaning);
    }
    add_table(r, &t, 7);
}

// --- rooms

/// The rooms, with what is seen of each from the map's first start.
static sl_status find_rooms(report *r) {
    const vga_work *w = &r->w;
    const isovist_scene scene = {
        .space = &w->baked.space, .query = w->query, .range = sl_query_range(w->query)};
    const size_t start = input_next_start(&w->baked.map, &w->baked.space, 0);
    SL_TRY(room_table_make(r->context, &w->baked, 0, &r->rooms));
    SL_TRY(room_table_average(r->context, &w->table, &r->rooms));
    if (start == w->baked.map.start_count) return SL_OK;
    eye_places eyes = {0};
    sl_status status =
        eyes_add(r->context, &eyes, (eye_place){.at = w->baked.map.starts[start].at, .fov = 360});
    if (status == SL_OK) status = room_table_look(r->context, &scene, &eyes, &r->rooms);
    eyes_destroy(r->context, &eyes);
    return status;
}

/// The mean of a measure over the points of a room.
static double mean_of(const room_table *rooms, uint32_t room, const char *name) {
    const size_t measure = sl_measure_find(SL_VGA, name);
    for (size_t m = 0; m < rooms->measure_count; m++)
        if (rooms->measures[m] == measure) return rooms->means[room * rooms->measure_count + m];
    return NAN;
}

/// The plan with the names of its rooms.
static void add_names(report *r) {
    const sl_rooms *rooms = &r->rooms.rooms;
    r->labels = sl_alloc_array(r->context, rooms->count, sizeof *r->labels);
    keep_status(r, r->labels ? SL_OK : SL_NO_MEMORY);
    for (uint32_t i = 0; i < rooms->count && r->labels; i++)
        r->labels[i] = (sl_plan_label){.text = rooms->items[i].name,
                                       .at = rooms->items[i].at,
                                       .width = 2 * rooms->items[i].clearance};
    add(r, (sl_document_block){.kind = SL_BLOCK_PICTURE,
                               .baked = &r->w.baked,
                               .labels = r->labels,
                               .label_count = rooms->count});
}

static void add_rooms(report *r) {
    static const char *const head[] = {"room", "area", "share", "mean of integration",
                                       "mean of isovist area"};
    const room_table *rooms = &r->rooms;
    text_list t = {0};
    if (r->status == SL_OK) keep_status(r, find_rooms(r));
    if (r->status != SL_OK || !rooms->rooms.count) return;
    const bool seen = rooms->seen != NULL;
    add_text(r, SL_BLOCK_HEADING, "Rooms");
    add_text(r, SL_BLOCK_TEXT,
             say(r,
                 "What walls enclose once doors, and openings up to %s %s wide, are shut. Sight "
                 "goes through doors that are open.%s",
                 number(r, rooms->rooms.width), *length_unit(r) ? length_unit(r) : "units",
                 seen ? " The last column is what of the room is seen from the first start." : ""));
    add_names(r);
    for (size_t c = 0; c < 5; c++) add_cell(r, &t, head[c]);
    if (seen) add_cell(r, &t, "seen");
    for (uint32_t i = 0; i < rooms->rooms.count; i++) {
        const sl_room *room = &rooms->rooms.items[i];
        add_cell(r, &t, keep(r, room->name));
        add_cell(r, &t, number(r, room->area));
        add_cell(r, &t, say(r, "%.1f %%", 100 * room->area / rooms->inside));
        add_cell(r, &t, number(r, mean_of(rooms, i, "visual_integration_hh")));
        add_cell(r, &t, number(r, mean_of(rooms, i, "area")));
        if (seen) add_cell(r, &t, say(r, "%.1f %%", 100 * fmin(rooms->seen[i] / room->area, 1)));
    }
    add_table(r, &t, seen ? 6 : 5);
}

// --- axial lines

static sl_status find_axial(report *r) {
    axial_part *a = &r->axial;
    const sl_axial_options options = {.threads = r->plan->graph.options.threads};
    SL_TRY(sl_axial_all_lines(r->context, r->w.outline, options.threads, &a->lines));
    SL_TRY(sl_axial_fewest(r->context, &a->lines, true));
    SL_TRY(sl_line_graph_make(r->context, a->lines.lines, a->lines.count, &a->graph));
    a->measures = sl_alloc_array(r->context, a->lines.count, sizeof *a->measures);
    a->values = sl_alloc_array(r->context, a->lines.count, sizeof *a->values);
    if (!a->measures || !a->values) return SL_NO_MEMORY;
    SL_TRY(sl_axial_measure(r->context, a->lines.lines, &a->graph, &options, a->measures));
    for (uint32_t i = 0; i < a->lines.count; i++) a->values[i] = a->measures[i].integration_hh;
    a->drawn = (sl_drawn_lines){.name = "integration",
                                .lines = a->lines.lines,
                                .values = a->values,
                                .count = a->lines.count};
    return SL_OK;
}

static void add_axial_table(report *r) {
    size_t count;
    const sl_measure *measures = sl_measures(SL_AXIAL, &count);
    text_list t = {0};
    for (int c = 0; c < 3; c++)
        add_cell(r, &t, (const char *const[]){"measure", "mean", "meaning"}[c]);
    for (size_t k = 0; k < count; k++) {
        char words[64];
        double sum = 0, defined = 0;
        for (uint32_t i = 0; i < r->axial.lines.count; i++) {
            const double value = sl_measure_value(&measures[k], &r->axial.measures[i]);
            if (isnan(value)) continue;
            sum += value;
            defined++;
        }
        words_of(measures[k].name, words, sizeof words);
        add_cell(r, &t, keep(r, words));
        add_cell(r, &t, number(r, defined > 0 ? sum / defined : NAN));
        add_cell(r, &t, measures[k].meaning);
    }
    add_table(r, &t, 3);
}

/// Why a report has no axial lines; NULL where it has.
static const char *no_axial(report *r) {
    const sl_map *map = &r->w.baked.map;
    if (map->oneway_count || map->range > 0 || sl_map_limited_walls(map))
        return "Left out: the plan has one-way glass, a view range or walls that limit sight, and "
               "axial lines end at walls and shut doors alone.";
    if (r->w.baked.space.wall_count <= AXIAL_WALLS) return NULL;
    return say(r,
               "Left out: the plan has %" PRIu32 " walls, and with more than %d they may take "
               "minutes. The command 'sightline axial' finds them.",
               r->w.baked.space.wall_count, AXIAL_WALLS);
}

static void add_axial(report *r) {
    const sl_baked *baked = &r->w.baked;
    add_text(r, SL_BLOCK_HEADING, "Axial lines");
    const char *left_out = no_axial(r);
    if (left_out) {
        add_text(r, SL_BLOCK_TEXT, left_out);
        return;
    }
    if (r->status == SL_OK) keep_status(r, find_axial(r));
    if (r->status != SL_OK) return;
    if (!r->axial.lines.count) {
        add_text(r, SL_BLOCK_TEXT, "The plan has none: none of its corners is inside.");
        return;
    }
    add_text(r, SL_BLOCK_TEXT,
             say(r, "%" PRIu32 " axial line%s, coloured by integration.", r->axial.lines.count,
                 r->axial.lines.count == 1 ? "" : "s"));
    add(r, (sl_document_block){.kind = SL_BLOCK_PICTURE, .baked = baked, .lines = &r->axial.drawn});
    add_axial_table(r);
}

// --- method

/// How it was decided what is inside.
static const char *inside_said(report *r) {
    const sl_map *map = &r->w.baked.map;
    if (map->start_count) return "Inside is what can be reached from the starts of the map.";
    if (map->interior.width > 0)
        return say(r, "Inside is what a disc of diameter %s %s cannot enter from outside the plan.",
                   number(r, map->interior.width), length_unit(r));
    return "Inside is what walls or solid ground enclose.";
}

static void add_method(report *r) {
    add_text(r, SL_BLOCK_HEADING, "Method and exactness");
    add_text(r, SL_BLOCK_TEXT,
             "Walls are cleaned first: they then meet at common ends only. Where walls cross, the "
             "place is rounded to the nearest number that the computer has. All that follows is "
             "exact for these walls.");
    add_text(r, SL_BLOCK_TEXT, inside_said(r));
    add_text(r, SL_BLOCK_TEXT,
             "Two points see each other if the straight line between them crosses no wall; it may "
             "touch one. This is decided by exact signs, without a tolerance. So the pairs of "
             "points that see each other are exact, and so are all counts: connectivity, steps, "
             "node count. Other measures are computed from these in double precision.");
    add_text(r, SL_BLOCK_TEXT,
             "Visible regions have exact corners where these are corners of walls; other corners "
             "are rounded once. Areas and lengths are sums in double precision.");
    add_text(r, SL_BLOCK_TEXT,
             say(r,
                 "Values are those at the points of the grid, and nothing is interpolated. What is "
                 "narrower than the step of %s %s may lie between the points.",
                 number(r, r->w.table.grid.step), *length_unit(r) ? length_unit(r) : "units"));
    if (r->axial.lines.count)
        add_text(r, SL_BLOCK_TEXT,
                 "Axial lines pass two corners that see each other, which is exact; their ends are "
                 "rounded. Lines are dropped, shortest first, while the others still cover the "
                 "plan. No proof says that fewer lines could not do it.");
    add_text(r, SL_BLOCK_TEXT, say(r, "Computed by Sightline %s.", sl_version()));
}

// --- the report

static sl_status build(report *r) {
    add_text(r, SL_BLOCK_TITLE, r->plan->title ? r->plan->title : file_name(r));
    add_plan(r);
    add_measures(r);
    add_heat_maps(r);
    add_rooms(r);
    add_axial(r);
    add_method(r);
    return r->status;
}

static void destroy(report *r) {
    sl_context *context = r->context;
    for (size_t i = 0; i < r->texts.count; i++) sl_free(context, r->texts.items[i]);
    for (size_t i = 0; i < r->tables.count; i++) sl_free(context, r->tables.items[i]);
    for (size_t i = 0; i < r->fields.count; i++) {
        vga_field_destroy(context, r->fields.items[i]);
        sl_free(context, r->fields.items[i]);
    }
    void *const arrays[] = {r->texts.items,    r->tables.items, r->fields.items, r->blocks.items,
                            r->axial.measures, r->axial.values, r->labels};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) sl_free(context, arrays[i]);
    room_table_destroy(context, &r->rooms);
    sl_axial_lines_destroy(context, &r->axial.lines);
    sl_line_graph_destroy(context, &r->axial.graph);
    vga_work_destroy(context, &r->w);
}

/// Names of measures are read, and their groups are computed.
static sl_status choose_measures(sl_context *context, plan_report_plan *plan) {
    const name_table names = measure_table(SL_VGA);
    plan->graph.parts = VGA_PART_VISUAL | VGA_PART_THROUGH | VGA_PART_ISOVIST;
    for (size_t i = 0; i < plan->measures.count; i++) {
        size_t measure;
        SL_TRY(read_choice(context, "--measure", plan->measures.items[i], &names, &measure));
        if (vga_measure_part(measure) >= VGA_PART_STEPS)
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "--measure %s: it needs places to start from, which a report has not; "
                           "'sightline vga' takes some",
                           plan->measures.items[i]);
        plan->graph.parts |= vga_measure_part(measure);
    }
    return SL_OK;
}

sl_status plan_report_write(sl_context *context, plan_report_plan *plan, const char *path) {
    report r = {.context = context, .plan = plan};
    SL_TRY(choose_measures(context, plan));
    sl_status status = vga_compute(context, &plan->graph, &r.w);
    if (status == SL_OK) status = build(&r);
    if (status == SL_OK)
        status = built_pictures()->document(context, r.blocks.items, r.blocks.count,
                                            r.blocks.items[0].text, path);
    destroy(&r);
    return status;
}
