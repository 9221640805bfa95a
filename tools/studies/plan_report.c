/// What a report says of a plan. Every figure is computed from the map that is read.
#include "studies/plan_report.h"

#include "reports/fields.h"
#include "reports/summary.h"
#include "sightline/axial.h"
#include "sightline/support.h"
#include "sightline/version.h"
#include "studies/report_cameras.h"
#include "studies/room_table.h"
#include "system/built.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/// Beyond so many walls, axial lines take minutes.
enum { AXIAL_WALLS = 2000 };

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
    report_cameras cameras;
    SL_ARRAY(vga_field *) fields; ///< that blocks have
    report_blocks blocks;
} report;

/// Names of files may be of any bytes.
static const char *file_name(report *r) {
    char readable[256];
    const char *name = sl_path_name(r->plan->graph.input);
    text_make_readable(strcmp(name, "-") ? name : "standard input", readable, sizeof readable);
    return blocks_keep(&r->blocks, readable);
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
    blocks_add_text(&r->blocks, SL_BLOCK_HEADING, "The plan");
    blocks_add(&r->blocks, (sl_document_block){.kind = SL_BLOCK_PICTURE, .baked = &r->w.baked});
    blocks_add_row(&r->blocks, &t, "what", "value");
    blocks_add_row(&r->blocks, &t, "file", file_name(r));
    blocks_add_row(&r->blocks, &t, "unit of lengths",
                   *map->unit ? map->unit : "the file does not say");
    blocks_add_row(&r->blocks, &t, "size",
                   blocks_say(&r->blocks, "%s x %s %s",
                              blocks_number(&r->blocks, b.max.x - b.min.x),
                              blocks_number(&r->blocks, b.max.y - b.min.y), unit));
    blocks_add_row(&r->blocks, &t, "walls after cleaning",
                   blocks_say(&r->blocks, "%" PRIu32, space->wall_count));
    if (map->door_count)
        blocks_add_row(&r->blocks, &t, "doors",
                       blocks_say(&r->blocks, "%zu, %zu of them open", map->door_count, open));
    if (map->oneway_count)
        blocks_add_row(&r->blocks, &t, "one-way glass",
                       blocks_say(&r->blocks, "%zu", map->oneway_count));
    if (map->range > 0)
        blocks_add_row(
            &r->blocks, &t, "view range",
            blocks_say(&r->blocks, "%s %s", blocks_number(&r->blocks, map->range), unit));
    blocks_add_row(&r->blocks, &t, "area inside",
                   blocks_say(&r->blocks, "%s square %s, %.1f %% of the whole",
                              blocks_number(&r->blocks, area), unit,
                              all > 0 ? 100 * area / all : 0));
    blocks_add_row(&r->blocks, &t, "convex cells inside",
                   blocks_say(&r->blocks, "%" PRIu32, inside));
    blocks_add_table(&r->blocks, &t, 2);
}

// --- measures on the grid

/// Mean, deviation and ends of the values that are defined.
typedef struct value_summary {
    bool known; ///< there is a value
    double mean, deviation, least, most;
} value_summary;

/// Of several parts the largest counts, where the measure goes by parts.
static bool counts(const vga_table *t, size_t measure, uint32_t p) {
    return !(t->part_count > 1 && t->part[p] && vga_measure_is_of_part(measure));
}

/// A measure on the grid of a report.
typedef struct counted_measure {
    const vga_table *table;
    size_t measure;
} counted_measure;

static double counted_value(const void *of, size_t p) {
    const counted_measure *m = of;
    return counts(m->table, m->measure, (uint32_t)p) ? vga_value(m->table, m->measure, (uint32_t)p)
                                                     : NAN;
}

static value_summary summarise(const vga_table *t, size_t measure) {
    const counted_measure of = {t, measure};
    value_summary s = {.least = INFINITY, .most = -INFINITY};
    s.known =
        summary_mean(&(summary_values){counted_value, &of, t->grid.count}, &s.mean, &s.deviation);
    for (uint32_t p = 0; p < t->grid.count; p++) {
        const double value = counted_value(&of, p); // NAN loses against a number
        s.least = fmin(s.least, value);
        s.most = fmax(s.most, value);
    }
    return s;
}

static void add_heat_map(report *r, size_t measure) {
    const sl_measure *m = &sl_measures(SL_VGA, &(size_t){0})[measure];
    char unit[SL_UNIT_TEXT], words[64];
    blocks_keep_status(&r->blocks, SL_ARRAY_ROOM(r->context, &r->fields, 1));
    vga_field *field =
        r->blocks.status == SL_OK ? sl_alloc_array(r->context, 1, sizeof *field) : NULL;
    blocks_keep_status(&r->blocks, field ? SL_OK : SL_NO_MEMORY);
    if (r->blocks.status != SL_OK) return;
    r->fields.items[r->fields.count++] = field;
    blocks_keep_status(&r->blocks, vga_field_make(r->context, &r->w, measure, NULL, field));
    words_of(m->name, words, sizeof words);
    sl_measure_say_unit(m, length_unit(r), unit);
    field->field.name = blocks_keep(&r->blocks, words);
    field->field.unit = *unit ? blocks_keep(&r->blocks, unit) : NULL;
    blocks_add_text(&r->blocks, SL_BLOCK_HEADING, field->field.name);
    blocks_add_text(&r->blocks, SL_BLOCK_TEXT,
                    blocks_say(&r->blocks, "%s: %s.", field->field.name, m->meaning));
    blocks_add(&r->blocks, (sl_document_block){.kind = SL_BLOCK_PICTURE,
                                               .baked = &r->w.baked,
                                               .field = &field->field});
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
    blocks_add_text(&r->blocks, SL_BLOCK_HEADING, "Measures");
    blocks_add_text(
        &r->blocks, SL_BLOCK_TEXT,
        blocks_say(
            &r->blocks,
            "%" PRIu32 " points of a grid with a step of %s %s. The names are those of "
            "depthmapX.%s",
            table->grid.count, blocks_number(&r->blocks, table->grid.step),
            *length_unit(r) ? length_unit(r) : "units",
            table->part_count > 1
                ? blocks_say(&r->blocks,
                             " No sightline joins the %" PRIu32
                             " parts of the graph: measures of the graph are those of the largest "
                             "part, with %" PRIu32 " points.",
                             table->part_count, vga_part_size(table, 0))
                : ""));
    blocks_add_head(&r->blocks, &t, head, 7);
    for (size_t k = 0; k < count; k++) {
        if (!(table->parts & vga_measure_part(k))) continue;
        char unit[SL_UNIT_TEXT], words[64];
        const value_summary s = summarise(table, k);
        words_of(measures[k].name, words, sizeof words);
        sl_measure_say_unit(&measures[k], length_unit(r), unit);
        blocks_add_cell(&r->blocks, &t, blocks_keep(&r->blocks, words));
        for (int c = 0; c < 4; c++)
            blocks_add_cell(&r->blocks, &t,
                            blocks_number(&r->blocks, !s.known ? NAN
                                                      : c == 0 ? s.mean
                                                      : c == 1 ? s.deviation
                                                      : c == 2 ? s.least
                                                               : s.most));
        blocks_add_cell(&r->blocks, &t, blocks_keep(&r->blocks, unit));
        blocks_add_cell(&r->blocks, &t, measures[k].meaning);
    }
    blocks_add_table(&r->blocks, &t, 7);
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
    blocks_keep_status(&r->blocks, r->labels ? SL_OK : SL_NO_MEMORY);
    for (uint32_t i = 0; i < rooms->count && r->labels; i++)
        r->labels[i] = (sl_plan_label){.text = rooms->items[i].name,
                                       .at = rooms->items[i].at,
                                       .width = 2 * rooms->items[i].clearance};
    blocks_add(&r->blocks, (sl_document_block){.kind = SL_BLOCK_PICTURE,
                                               .baked = &r->w.baked,
                                               .labels = r->labels,
                                               .label_count = rooms->count});
}

static void add_rooms(report *r) {
    const room_table *rooms = &r->rooms;
    text_list t = {0};
    if (r->blocks.status == SL_OK) blocks_keep_status(&r->blocks, find_rooms(r));
    if (r->blocks.status != SL_OK || !rooms->rooms.count) return;
    const bool seen = rooms->seen != NULL;
    blocks_add_text(&r->blocks, SL_BLOCK_HEADING, "Rooms");
    const char *narrow = "";
    if (rooms->rooms.width > 0)
        narrow = blocks_say(&r->blocks, ", and openings up to %s %s wide,",
                            blocks_number(&r->blocks, rooms->rooms.width),
                            *length_unit(r) ? length_unit(r) : "units");
    blocks_add_text(
        &r->blocks, SL_BLOCK_TEXT,
        blocks_say(&r->blocks,
                   "What walls enclose once doors%s are shut. Sight goes through doors that are "
                   "open.%s",
                   narrow,
                   seen ? " The last column is what of the room is seen from the first start."
                        : ""));
    add_names(r);
    const char *unit =
        *length_unit(r) ? blocks_say(&r->blocks, ", %s\xc2\xb2", length_unit(r)) : "";
    const char *const head[] = {"room", blocks_say(&r->blocks, "area%s", unit), "share",
                                "mean of integration",
                                blocks_say(&r->blocks, "mean of isovist area%s", unit)};
    blocks_add_head(&r->blocks, &t, head, 5);
    if (seen) blocks_add_cell(&r->blocks, &t, "seen");
    for (uint32_t i = 0; i < rooms->rooms.count; i++) {
        const sl_room *room = &rooms->rooms.items[i];
        blocks_add_cell(&r->blocks, &t, blocks_keep(&r->blocks, room->name));
        blocks_add_cell(&r->blocks, &t, blocks_number(&r->blocks, room->area));
        blocks_add_cell(&r->blocks, &t,
                        blocks_say(&r->blocks, "%.1f %%", 100 * room->area / rooms->inside));
        blocks_add_cell(&r->blocks, &t,
                        blocks_number(&r->blocks, mean_of(rooms, i, "visual_integration_hh")));
        blocks_add_cell(&r->blocks, &t, blocks_number(&r->blocks, mean_of(rooms, i, "area")));
        if (seen)
            blocks_add_cell(
                &r->blocks, &t,
                blocks_say(&r->blocks, "%.1f %%", 100 * fmin(rooms->seen[i] / room->area, 1)));
    }
    blocks_add_table(&r->blocks, &t, seen ? 6 : 5);
}

// --- cameras

static void add_cameras(report *r) {
    const report_cameras_scene scene = {.table = r->plan->cameras,
                                        .input = file_name(r),
                                        .baked = &r->w.baked,
                                        .query = r->w.query,
                                        .rooms = &r->rooms.rooms};
    if (scene.table && r->blocks.status == SL_OK)
        blocks_keep_status(&r->blocks,
                           report_cameras_add(r->context, &scene, &r->blocks, &r->cameras));
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
    blocks_add_head(&r->blocks, &t, (const char *const[]){"measure", "mean", "meaning"}, 3);
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
        blocks_add_cell(&r->blocks, &t, blocks_keep(&r->blocks, words));
        blocks_add_cell(&r->blocks, &t,
                        blocks_number(&r->blocks, defined > 0 ? sum / defined : NAN));
        blocks_add_cell(&r->blocks, &t, measures[k].meaning);
    }
    blocks_add_table(&r->blocks, &t, 3);
}

/// Why a report has no axial lines; NULL where it has.
static const char *no_axial(report *r) {
    const sl_map *map = &r->w.baked.map;
    if (map->oneway_count || map->range > 0 || sl_map_limited_walls(map))
        return "Left out: the plan has one-way glass, a view range or walls that limit sight, and "
               "axial lines end at walls and shut doors alone.";
    if (r->w.baked.space.wall_count <= AXIAL_WALLS) return NULL;
    return blocks_say(&r->blocks,
                      "Left out: the plan has %" PRIu32
                      " walls, and with more than %d they may take "
                      "minutes. The command 'sightline axial' finds them.",
                      r->w.baked.space.wall_count, AXIAL_WALLS);
}

static void add_axial(report *r) {
    const sl_baked *baked = &r->w.baked;
    blocks_add_text(&r->blocks, SL_BLOCK_HEADING, "Axial lines");
    const char *left_out = no_axial(r);
    if (left_out) {
        blocks_add_text(&r->blocks, SL_BLOCK_TEXT, left_out);
        return;
    }
    if (r->blocks.status == SL_OK) blocks_keep_status(&r->blocks, find_axial(r));
    if (r->blocks.status != SL_OK) return;
    if (!r->axial.lines.count) {
        blocks_add_text(&r->blocks, SL_BLOCK_TEXT,
                        "The plan has none: none of its corners is inside.");
        return;
    }
    blocks_add_text(&r->blocks, SL_BLOCK_TEXT,
                    blocks_say(&r->blocks, "%" PRIu32 " axial line%s, coloured by integration.",
                               r->axial.lines.count, r->axial.lines.count == 1 ? "" : "s"));
    blocks_add(&r->blocks, (sl_document_block){
                               .kind = SL_BLOCK_PICTURE, .baked = baked, .lines = &r->axial.drawn});
    add_axial_table(r);
}

// --- method

/// How it was decided what is inside.
static const char *inside_said(report *r) {
    const sl_map *map = &r->w.baked.map;
    if (map->start_count) return "Inside is what can be reached from the starts of the map.";
    if (map->interior.width > 0)
        return blocks_say(
            &r->blocks,
            "Inside is what a disc of diameter %s %s cannot enter from outside the plan.",
            blocks_number(&r->blocks, map->interior.width), length_unit(r));
    return "Inside is what walls or solid ground enclose.";
}

static void add_method(report *r) {
    blocks_add_text(&r->blocks, SL_BLOCK_HEADING, "Method and exactness");
    blocks_add_text(
        &r->blocks, SL_BLOCK_TEXT,
        "Walls are cleaned first: they then meet at common ends only. Where walls cross, the "
        "place is rounded to the nearest number that the computer has. All that follows is "
        "exact for these walls.");
    blocks_add_text(&r->blocks, SL_BLOCK_TEXT, inside_said(r));
    blocks_add_text(
        &r->blocks, SL_BLOCK_TEXT,
        "Two points see each other if the straight line between them crosses no wall; it may "
        "touch one. This is decided by exact signs, without a tolerance. So the pairs of "
        "points that see each other are exact, and so are all counts: connectivity, steps, "
        "node count. Other measures are computed from these in double precision.");
    blocks_add_text(
        &r->blocks, SL_BLOCK_TEXT,
        "Visible regions have exact corners where these are corners of walls; other corners "
        "are rounded once. Areas and lengths are sums in double precision.");
    blocks_add_text(
        &r->blocks, SL_BLOCK_TEXT,
        blocks_say(
            &r->blocks,
            "Values are those at the points of the grid, and nothing is interpolated. What is "
            "narrower than the step of %s %s may lie between the points.",
            blocks_number(&r->blocks, r->w.table.grid.step),
            *length_unit(r) ? length_unit(r) : "units"));
    if (r->cameras.coverage.count)
        blocks_add_text(
            &r->blocks, SL_BLOCK_TEXT,
            "What each camera sees is decided in the same way. Where a range ends, chords lie "
            "within it, up to 0.01 percent of the range off: nothing counts that is not seen. "
            "Corners at which regions cross are rounded once.");
    if (r->axial.lines.count)
        blocks_add_text(
            &r->blocks, SL_BLOCK_TEXT,
            "Axial lines pass two corners that see each other, which is exact; their ends are "
            "rounded. Lines are dropped, shortest first, while the others still cover the "
            "plan. No proof says that fewer lines could not do it.");
    blocks_add_text(&r->blocks, SL_BLOCK_TEXT,
                    blocks_say(&r->blocks, "Computed by Sightline %s.", sl_version()));
}

// --- the report

static sl_status build(report *r) {
    blocks_add_text(&r->blocks, SL_BLOCK_TITLE, r->plan->title ? r->plan->title : file_name(r));
    add_plan(r);
    add_measures(r);
    add_heat_maps(r);
    add_rooms(r);
    add_cameras(r);
    add_axial(r);
    add_method(r);
    return r->blocks.status;
}

static void destroy(report *r) {
    sl_context *context = r->context;
    blocks_destroy(&r->blocks);
    report_cameras_destroy(context, &r->cameras);
    for (size_t i = 0; i < r->fields.count; i++) {
        vga_field_destroy(context, r->fields.items[i]);
        sl_free(context, r->fields.items[i]);
    }
    void *const arrays[] = {r->fields.items, r->axial.measures, r->axial.values, r->labels};
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
    report r = {.context = context, .plan = plan, .blocks = {.context = context}};
    SL_TRY(choose_measures(context, plan));
    sl_status status = vga_compute(context, &plan->graph, &r.w);
    if (status == SL_OK) status = build(&r);
    if (status == SL_OK)
        status = built_pictures()->document(context, r.blocks.list.items, r.blocks.list.count,
                                            r.blocks.list.items[0].text, path);
    destroy(&r);
    return status;
}
