/// What a plan is asked beside its layers: its scale by a line of a known length, a place that is
/// inside, and openings that leak.
///
/// Leaks are those of the map that is open (sl_find_faults), found in the background. A map without
/// a start has none; there the opening counts that may be an entrance (sl_interior.doubtful).
#include "dialogs/import_parts.h"

#include "document/measure.h"
#include "sightline/draw.h"
#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEAKS_MOST = 200, LEAK_ROWS = 4 };

// --- leaks

struct leak_job {
    sl_map map;
    sl_clean_options clean;
    sl_faults faults;
};

static sl_status find_leaks(sl_context *context, void *data) {
    struct leak_job *job = data;
    const sl_faults_options options = {.clean = &job->clean};
    sl_map clean = {0};
    sl_space space = {0};
    SL_TRY(sl_map_copy(context, &job->map, &clean));
    sl_status status = sl_map_clean(context, &clean, &job->clean, NULL);
    if (status == SL_OK)
        status = sl_subdivision_for(&clean)->subdivide(context, &clean, NULL, &space);
    if (status == SL_OK)
        status = sl_find_faults(context, &job->map, &space, &options, &job->faults);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &clean);
    return status;
}

static void drop_job(sl_context *context, import_state *s) {
    task_drop(context, s->leak_task);
    s->leak_task = NULL;
    if (s->leak_job) {
        sl_map_destroy(context, &s->leak_job->map);
        sl_faults_destroy(context, &s->leak_job->faults);
    }
    sl_free(context, s->leak_job);
    s->leak_job = NULL;
}

static void drop_leaks(sl_context *context, import_state *s) {
    sl_free(context, s->leaks);
    sl_free(context, s->widths);
    s->leaks = NULL;
    s->widths = NULL;
    s->leak_list = (dialog_list){.marks = true};
}

void import_plan_end(sl_context *context, import_state *s) {
    drop_job(context, s);
    drop_leaks(context, s);
}

static sl_status keep_leaks(sl_context *context, import_state *s, const sl_faults *faults,
                            const sl_interior *interior) {
    const bool doubtful = !s->has_start && interior->doubtful_width > 0;
    const size_t most = s->has_start ? faults->counts[SL_FAULT_LEAK] : doubtful;
    drop_leaks(context, s);
    s->leaks = sl_alloc_array(context, most + 1, sizeof *s->leaks);
    s->widths = sl_alloc_array(context, most + 1, sizeof *s->widths);
    if (!s->leaks || !s->widths) return SL_NO_MEMORY;
    size_t count = 0;
    if (doubtful) {
        s->leaks[count] = interior->doubtful;
        s->widths[count++] = interior->doubtful_width;
    }
    for (uint32_t i = 0; i < faults->count && count < most && count < LEAKS_MOST; i++) {
        if (faults->items[i].kind != SL_FAULT_LEAK) continue;
        s->leaks[count] = faults->items[i].at;
        s->widths[count++] = faults->items[i].size;
    }
    s->leak_list.count = count;
    return SL_OK;
}

/// Places that nothing leads to may be rooms whose doors are drawn shut, or courts and shafts.
static sl_status say_sealed(const desk_state *desk, import_state *s) {
    const sl_baked *baked = desk->document->baked;
    sl_sealed sealed;
    SL_TRY(sl_find_sealed(desk->context, &baked->map, &baked->space, &sealed));
    const sl_point at = sealed.largest.at;
    char area[MEASURE_TEXT];
    if (sealed.rooms < 2 || !(sealed.largest.area > 0)) return SL_OK;
    measure_say(sealed.largest.area, desk->document->map.unit, "\xc2\xb2", area);
    snprintf(s->said_sealed, sizeof s->said_sealed,
             "%u closed part%s, the largest of %s at %.4g, %.4g, count%s as inside, too. "
             "Where these are courts or shafts, 'Here is inside' leaves them out.",
             (unsigned)sealed.rooms - 1, sealed.rooms == 2 ? "" : "s", area, at.x, at.y,
             sealed.rooms == 2 ? "s" : "");
    return SL_OK;
}

static sl_status start_leaks(desk_state *desk, import_state *s) {
    const document_state *document = desk->document;
    const sl_faults none = {0};
    s->has_start = document->map.start_count > 0;
    if (!s->has_start) {
        SL_TRY(say_sealed(desk, s));
        return keep_leaks(desk->context, s, &none, &document->baked->map.interior);
    }
    s->leak_job = sl_alloc_array(desk->context, 1, sizeof *s->leak_job);
    if (!s->leak_job) return SL_NO_MEMORY;
    s->leak_job->clean = sl_clean_options_default();
    if (s->source.has_weld) s->leak_job->clean.weld = s->source.weld;
    SL_TRY(sl_map_copy(desk->context, &document->map, &s->leak_job->map));
    return task_start(desk->context, find_leaks, s->leak_job, NULL, NULL, &s->leak_task);
}

static double inside_share(const document_state *document) {
    const sl_box b = document->baked->space.bounds;
    return document->inside_area / (box_width(b) * box_height(b));
}

/// A scale says how wide an entrance is, so it may change what is inside.
static void say_scaled(const desk_state *desk, import_state *s) {
    const double now = inside_share(desk->document), before = s->share_before;
    const double width = desk->document->baked->map.interior.width;
    char said[MEASURE_TEXT];
    measure_say(width, desk->document->map.unit, "", said);
    s->scales = false;
    s->said_scale[0] = '\0';
    if (fabs(now - before) <= 1e-6 || s->has_start) return;
    snprintf(s->said_scale, sizeof s->said_scale,
             "The scale changes what is inside: %.3g %% of the plan, and %.3g %% before. Openings "
             "up to %s count as entrances now: say another width, or what is inside.",
             100 * now, 100 * before, said);
}

void import_plan_follow(desk_state *desk, import_state *s) {
    const document_state *document = desk->document;
    sl_status status = SL_OK;
    if (!document->baked) return;
    if (s->leaks_of != document->read) {
        s->leaks_of = document->read;
        s->unitless |= !*document->map.unit;
        s->line_ends = 0;
        s->said_sealed[0] = '\0';
        if (s->scales)
            say_scaled(desk, s);
        else
            s->said_scale[0] = '\0';
        drop_job(desk->context, s);
        drop_leaks(desk->context, s);
        status = start_leaks(desk, s);
    }
    if (status == SL_OK && s->leak_task && (desk->ui->steady || task_done(s->leak_task))) {
        status = task_end(desk->context, s->leak_task);
        s->leak_task = NULL;
        if (status == SL_OK)
            status = keep_leaks(desk->context, s, &s->leak_job->faults, &(sl_interior){0});
        drop_job(desk->context, s);
    }
    if (status != SL_OK && status != SL_CANCELLED)
        snprintf(s->problem, sizeof s->problem, "%s", sl_context_message(desk->context));
}

/// A leak is closed by a wall: inside goes through doors. Without a start the entrances get as
/// wide.
static void close_leak(desk_state *desk, import_state *s, size_t number) {
    if (number >= s->leak_list.count) return;
    if (s->has_start) {
        const sl_status status = document_source_close(desk->context, &s->source, s->leaks[number]);
        ui_report(desk->ui, desk->context, status);
    } else {
        import_set_number(&s->fields[FIELD_ENTRANCE], true, s->widths[number]);
    }
}

// --- the scale

const char *import_sign(const char *text) {
    static const char *const signs[] = {"mm", "cm", "km", "m", "in", "ft", "yd"};
    for (size_t i = 0; i < sizeof signs / sizeof *signs; i++)
        if (strcmp(text, signs[i]) == 0) return signs[i];
    return NULL;
}

/// The length that was typed, as "4.20 m" or "4,2"; the unit is m where none is said.
static bool read_length(import_state *s, double *length, const char **sign) {
    const char *unit;
    if (!measure_read(s->length.text, length, &unit)) return false;
    *sign = *unit ? import_sign(unit) : "m";
    return *sign && *length > 0;
}

/// How long a unit of the file is in the map as it is shown.
static double factor_now(const desk_state *desk) {
    const char *unit = desk->document->source.options.unit;
    const char *equals = unit ? strchr(unit, '=') : NULL;
    const double scale = desk->document->map.source.transform.scale;
    double factor;
    if (!unit) return 1;
    if (equals && sl_number_read(unit, (size_t)(equals - unit), &factor)) return factor;
    return scale > 0 ? 1 / scale : 1;
}

/// What was said in the map's places before is in the new unit now.
static void scale_said(import_state *s, double by) {
    static const int lengths[] = {FIELD_ENTRANCE, FIELD_WELD};
    sl_point start;
    for (size_t i = 0; i < s->source.closed_count; i++) {
        sl_segment *c = &s->source.closed[i];
        *c = (sl_segment){{c->a.x * by, c->a.y * by}, {c->b.x * by, c->b.y * by}};
    }
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
        text_field *field = &s->fields[lengths[i]];
        double length;
        if (sl_number_read(field->text, strlen(field->text), &length))
            import_set_number(field, true, length * by);
    }
    if (import_read_place(s->fields[FIELD_START].text, &start))
        import_set_place(&s->fields[FIELD_START], (sl_point){start.x * by, start.y * by});
}

void import_plan_scale(desk_state *desk, import_state *s) {
    const double x = s->line.b.x - s->line.a.x, y = s->line.b.y - s->line.a.y;
    const double drawn = hypot(x, y) / factor_now(desk);
    double length;
    const char *sign;
    char text[SL_NUMBER_TEXT], unit[SL_NUMBER_TEXT + 8];
    if (s->line_ends < 2 || !(drawn > 0)) {
        import_complain(s, "This line is", "measure a line in the plan first");
        return;
    }
    if (!read_length(s, &length, &sign)) {
        import_complain(s, "This line is", "a length is needed, as 4.20 m");
        return;
    }
    sl_number_write(length / drawn, text);
    snprintf(unit, sizeof unit, "%s=%s", text, sign);
    scale_said(s, length / drawn / factor_now(desk));
    field_set(&s->fields[FIELD_UNIT], unit);
    s->line_ends = 0;
    s->scales = desk->document->baked != NULL;
    if (s->scales) s->share_before = inside_share(desk->document);
    import_preview(desk, s);
    import_focus_home(desk, s, MEASURE);
}

// --- clicks

/// The nearest end of a wall, where one is within `reach`; else the place itself.
static sl_point snapped(const sl_map *map, sl_point at, double reach) {
    sl_point best = at;
    for (size_t i = 0; i < 2 * map->wall_count; i++) {
        const sl_wall *wall = &map->walls[i / 2];
        const sl_point end = i % 2 ? wall->b : wall->a;
        const double away = hypot(end.x - at.x, end.y - at.y);
        if (away > reach) continue;
        reach = away;
        best = end;
    }
    return best;
}

bool import_picks(const desk_state *desk) {
    const import_state *s = desk->dialog.import;
    if (!s || dialog_open_now(&desk->dialog) != DIALOG_IMPORT || s->pick == PICK_NONE) return false;
    return desk->dialog.focus[desk->dialog.depth - 1] ==
           (s->pick == PICK_INSIDE ? INSIDE : MEASURE);
}

void import_stop_picking(desk_state *desk) {
    desk->dialog.import->pick = PICK_NONE;
    desk->dialog.import->line_ends = 0;
}

void import_pick_at(desk_state *desk, sl_point at, double reach) {
    import_state *s = desk->dialog.import;
    if (s->pick != PICK_INSIDE) at = snapped(&desk->document->map, at, reach);
    s->problem[0] = '\0';
    switch (s->pick) {
    case PICK_INSIDE:
        import_set_place(&s->fields[FIELD_START], at);
        s->pick = PICK_NONE;
        import_preview(desk, s);
        import_focus_home(desk, s, INSIDE);
        break;
    case PICK_FIRST:
        s->line = (sl_segment){at, at};
        s->line_ends = 1;
        s->pick = PICK_SECOND;
        break;
    case PICK_SECOND:
        s->line.b = at;
        s->line_ends = 2;
        s->pick = PICK_NONE;
        desk->dialog.focus[desk->dialog.depth - 1] = LENGTH;
        break;
    case PICK_NONE:
        break;
    }
}

void import_plan_act(desk_state *desk, import_state *s, int id) {
    switch (id) {
    case MEASURE:
        s->pick = s->pick == PICK_FIRST ? PICK_NONE : PICK_FIRST;
        s->line_ends = 0;
        break;
    case SET_LENGTH:
        import_plan_scale(desk, s);
        break;
    case INSIDE:
        s->pick = s->pick == PICK_INSIDE ? PICK_NONE : PICK_INSIDE;
        break;
    case CLOSE:
        close_leak(desk, s, s->leak_list.at);
        import_preview(desk, s);
        break;
    case CLOSE_ALL:
        for (size_t i = 0; i < s->leak_list.count; i++) close_leak(desk, s, i);
        import_preview(desk, s);
        break;
    case REOPEN:
        s->source.closed_count = 0;
        import_preview(desk, s);
        break;
    default:
        break;
    }
}

bool import_mark_at(const desk_state *desk, size_t number, import_mark *out) {
    const import_state *s = desk->dialog.import;
    const bool shown = s && s->beside && dialog_open_now(&desk->dialog) == DIALOG_IMPORT;
    if (!shown) return false;
    if (number < s->leak_list.count) {
        *out = (import_mark){number == s->leak_list.at ? MARK_CHOSEN : MARK_LEAK, s->leaks[number],
                             s->widths[number]};
        return true;
    }
    number -= s->leak_list.count;
    if (number < s->source.closed_count) {
        *out = (import_mark){MARK_CLOSED, s->source.closed[number], 0};
        return true;
    }
    number -= s->source.closed_count;
    *out = (import_mark){s->line_ends == 2 ? MARK_LINE : MARK_END, s->line, 0};
    return number == 0 && s->line_ends > 0;
}

// --- the picture

#define SAID 0.92 ///< the size of what is said

/// What is said of the inside, in plain texts high.
static double said_height(ui_state *ui, const char *said) {
    if (!*said) return 0;
    const double width = (IMPORT_WIDE - 2) * ui->text;
    return ui_lines_height(ui, width, SAID, false, said) / ui->text + 0.4;
}

double import_plan_height(desk_state *desk, const import_state *s) {
    const double rows = s->leak_list.count ? fmin((double)s->leak_list.count, LEAK_ROWS) : 0;
    return 2 * DIALOG_ROW + 1.9 + (rows > 0 ? 1.7 * rows + 0.5 : 0) +
           (rows > 0 || s->source.closed_count ? DIALOG_ROW : 0) +
           said_height(desk->ui, s->said_scale) + said_height(desk->ui, s->said_sealed);
}

static double draw_said(desk_state *desk, sl_box box, double y, const char *said) {
    ui_state *ui = desk->ui;
    if (!*said) return y;
    ui_lines(ui, box.min.x, y + 1.1 * ui->text, box_width(box), SAID, false, ui->palette.start,
             said);
    return y + said_height(ui, said) * ui->text;
}

static double draw_scale(desk_state *desk, import_state *s, sl_box box, double y) {
    ui_state *ui = desk->ui;
    const double t = ui->text;
    const dialog_label measure = {MEASURE, s->pick == PICK_FIRST    ? "Click one end"
                                           : s->pick == PICK_SECOND ? "Click the other"
                                                                    : "Measure a line"};
    const dialog_label set = {SET_LENGTH, "Set"};
    if (s->line_ends < 2) {
        const double wide = dialog_buttons_width(&desk->dialog, &measure, 1);
        dialog_buttons(&desk->dialog, box.min.x + wide, y, &measure, 1);
        return y + DIALOG_ROW * t;
    }
    const double wide = dialog_buttons_width(&desk->dialog, &set, 1) + 0.6 * t;
    ui_text(ui, box.min.x, y + 1.25 * t, 1, false, ui->palette.ink, "This line is");
    dialog_field(&desk->dialog, LENGTH,
                 (sl_box){{box.min.x + 9.5 * t, y}, {box.max.x - wide, y + 1.8 * t}}, &s->length,
                 "as 4.20 m");
    dialog_buttons(&desk->dialog, box.max.x, y, &set, 1);
    return y + DIALOG_ROW * t;
}

static void draw_leaks(desk_state *desk, import_state *s, sl_box box, double y) {
    dialog_label buttons[3];
    int shown = 0;
    ui_state *ui = desk->ui;
    const double t = ui->text;
    const size_t count = s->leak_list.count;
    char text[128], unit[24] = "";
    if (*desk->document->map.unit) snprintf(unit, sizeof unit, " %s", desk->document->map.unit);
    if (count)
        snprintf(text, sizeof text, "%zu opening%s to the outside:", count, count == 1 ? "" : "s");
    else
        snprintf(text, sizeof text, "%s",
                 s->leak_task ? "Looking for openings to the outside ..." : "No opening leaks.");
    ui_text_within(ui, box.min.x, y + 1.25 * t, box_width(box), 1, ui->palette.ink, text);
    y += 1.9 * t;
    if (count) {
        const double high = 1.7 * t * fmin((double)count, LEAK_ROWS) + 0.2 * t;
        const sl_box frame = {{box.min.x, y}, {box.max.x, y + high}};
        dialog_list_frame(&desk->dialog, LEAKS, frame, &s->leak_list);
        const dialog_list *list = &s->leak_list;
        for (size_t i = list->first; i < count && i < list->first + list->page; i++) {
            const sl_box row = dialog_list_row(&desk->dialog, LEAKS, frame, list, i);
            snprintf(text, sizeof text, "%.4g%s at %.6g, %.6g", s->widths[i], unit, s->leaks[i].a.x,
                     s->leaks[i].a.y);
            ui_text_within(ui, row.min.x + 0.6 * t, row.min.y + 1.2 * t, box_width(row) - t, 1,
                           ui->palette.ink, text);
        }
        y = frame.max.y + 0.3 * t;
    }
    if (count) buttons[shown++] = (dialog_label){CLOSE, "Close it"};
    if (count > 1) buttons[shown++] = (dialog_label){CLOSE_ALL, "Close all"};
    if (s->source.closed_count) buttons[shown++] = (dialog_label){REOPEN, "Open again"};
    if (shown)
        dialog_buttons(&desk->dialog,
                       box.min.x + dialog_buttons_width(&desk->dialog, buttons, shown), y, buttons,
                       shown);
}

void import_plan_draw(desk_state *desk, import_state *s, sl_box box, double y) {
    const dialog_label inside = {INSIDE, s->pick == PICK_INSIDE ? "Click a place that is inside"
                                                                : "Here is inside"};
    const double t = desk->ui->text;
    y = draw_scale(desk, s, box, y);
    const double wide = dialog_buttons_width(&desk->dialog, &inside, 1);
    dialog_buttons(&desk->dialog, box.min.x + wide, y, &inside, 1);
    y = draw_said(desk, box, y + DIALOG_ROW * t, s->said_scale);
    y = draw_said(desk, box, y, s->said_sealed);
    draw_leaks(desk, s, box, y);
}
