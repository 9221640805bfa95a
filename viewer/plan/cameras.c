/// The table of cameras: changed by keys and by pointer, with its own undo, and drawn.
#include "plan/cameras.h"

#include "draw/draw_plan.h" // private: names are cut as in pictures
#include "plan/effects.h"
#include "plan/grid.h"
#include "sightline/draw.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { UNDO_TABLES = 100, SPOTS_DRAWN = 12, CAMERAS_NAMED = 4 };

/// The parts of a camera that the pointer takes hold of.
enum { PART_BODY, PART_HANDLE };

#define DEGREES (180 / 3.14159265358979323846)

// --- the layer

camera_layer *cameras_of(view_state *view) {
    if (view->cameras) return view->cameras;
    view->cameras = sl_alloc_array(view->context, 1, sizeof *view->cameras);
    if (!view->cameras) {
        view_check(view, SL_NO_MEMORY);
        return NULL;
    }
    view->cameras->chosen = SIZE_MAX;
    view->cameras->stamp = 1;
    view->cameras->like = (sl_viewpoint){.fov = 360};
    return view->cameras;
}

static void forget_tables(sl_context *context, sl_cameras *tables, size_t *count) {
    while (*count) sl_cameras_destroy(context, &tables[--*count]);
}

void camera_layer_destroy(sl_context *context, camera_layer *layer) {
    if (!layer) return;
    camera_jobs_destroy(context, layer->jobs);
    forget_tables(context, layer->done.items, &layer->done.count);
    forget_tables(context, layer->undone.items, &layer->undone.count);
    sl_free(context, layer->done.items);
    sl_free(context, layer->undone.items);
    sl_coverage_destroy(context, &layer->coverage);
    sl_cameras_destroy(context, &layer->table);
    sl_free(context, layer);
}

void cameras_clear(view_state *view) {
    camera_layer_destroy(view->context, view->cameras);
    view->cameras = NULL;
}

void camera_name(const camera_layer *layer, size_t camera, char text[CAMERA_NAME]) {
    const char *name = layer->table.items[camera].name;
    if (name)
        sli_text_copy(name, strlen(name), text, CAMERA_NAME);
    else
        snprintf(text, CAMERA_NAME, "%zu", camera + 1);
}

sl_camera *camera_chosen_row(const view_state *view) {
    const camera_layer *layer = view->cameras;
    if (!layer || layer->chosen >= layer->table.count) return NULL;
    return &layer->table.items[layer->chosen];
}

sl_viewpoint *camera_chosen(const view_state *view) {
    sl_camera *row = camera_chosen_row(view);
    return row ? &row->view : NULL;
}

// --- undo

static sl_status copy_table(sl_context *context, const sl_cameras *from, sl_cameras *to) {
    sl_status status = SL_OK;
    *to = (sl_cameras){0};
    for (size_t i = 0; i < from->count && status == SL_OK; i++)
        status = sl_cameras_add(context, to, &from->items[i]);
    if (status != SL_OK) sl_cameras_destroy(context, to);
    return status;
}

static sl_status keep_table(view_state *view) {
    camera_layer *layer = view->cameras;
    if (layer->done.count == UNDO_TABLES) {
        sl_cameras_destroy(view->context, &layer->done.items[0]);
        memmove(layer->done.items, layer->done.items + 1,
                --layer->done.count * sizeof *layer->done.items);
    }
    SL_TRY(SL_ARRAY_ROOM(view->context, &layer->done, 1));
    SL_TRY(copy_table(view->context, &layer->table, &layer->done.items[layer->done.count]));
    layer->done.count++;
    forget_tables(view->context, layer->undone.items, &layer->undone.count);
    return SL_OK;
}

void camera_keep(view_state *view) {
    if (cameras_of(view)) view_check(view, keep_table(view));
}

void camera_changed(view_state *view) {
    view->cameras->stamp++;
    view->cameras->proof[0] = '\0';
}

static bool same_views(const sl_viewpoint *a, const sl_viewpoint *b) {
    return a->at.x == b->at.x && a->at.y == b->at.y && a->heading == b->heading &&
           a->fov == b->fov && a->range == b->range && a->nearest == b->nearest &&
           a->sign == b->sign;
}

static bool same_tables(const sl_cameras *a, const sl_cameras *b) {
    bool same = a->count == b->count;
    for (size_t i = 0; i < a->count && same; i++)
        same = same_views(&a->items[i].view, &b->items[i].view) &&
               a->items[i].height == b->items[i].height && a->items[i].tilt == b->items[i].tilt;
    return same;
}

void camera_settle(view_state *view) {
    camera_layer *layer = view->cameras;
    if (!layer || !layer->done.count) return;
    sl_cameras *last = &layer->done.items[layer->done.count - 1];
    if (!same_tables(last, &layer->table)) return;
    sl_cameras_destroy(view->context, last);
    layer->done.count--;
}

bool camera_undo(view_state *view, bool redo) {
    camera_layer *layer = view->cameras;
    if (!layer || !(redo ? layer->undone.count : layer->done.count)) return false;
    if (redo)
        view_check(view, SL_ARRAY_ROOM(view->context, &layer->done, 1));
    else
        view_check(view, SL_ARRAY_ROOM(view->context, &layer->undone, 1));
    if ((redo ? layer->done.capacity == layer->done.count
              : layer->undone.capacity == layer->undone.count))
        return false;
    const sl_cameras now = layer->table;
    if (redo) {
        layer->table = layer->undone.items[--layer->undone.count];
        layer->done.items[layer->done.count++] = now;
    } else {
        layer->table = layer->done.items[--layer->done.count];
        layer->undone.items[layer->undone.count++] = now;
    }
    if (layer->chosen >= layer->table.count) layer->chosen = SIZE_MAX;
    camera_changed(view);
    return true;
}

// --- the table, changed

bool camera_has_ground(const view_state *view, sl_point at) {
    const sl_baked *baked = view->document->baked;
    const uint32_t cell = baked ? sl_space_locate(&baked->space, at) : SL_NO_CELL;
    return cell != SL_NO_CELL && sl_baked_counts(baked, cell);
}

static void add_row(view_state *view, const sl_camera *camera) {
    camera_layer *layer = view->cameras;
    camera_keep(view);
    const sl_status status = sl_cameras_add(view->context, &layer->table, camera);
    view_check(view, status);
    if (status == SL_OK) layer->chosen = layer->table.count - 1;
    camera_changed(view);
}

void camera_add(view_state *view, sl_point at) {
    camera_layer *layer = cameras_of(view);
    if (!layer || !view->document->baked) return;
    if (!camera_has_ground(view, at)) {
        ui_say(view->ui, false, "no camera can stand here: click in a room");
        return;
    }
    sl_camera camera = {.view = layer->like, .cost = 1};
    camera.view.at = at;
    add_row(view, &camera);
}

void camera_copy(view_state *view) {
    if (!camera_chosen(view)) {
        ui_say(view->ui, false, "choose a camera first: click on it");
        return;
    }
    sl_camera camera = view->cameras->table.items[view->cameras->chosen];
    const double by = 40 * ui_scale(view->ui) / view->camera.scale;
    static const int sides[][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    const sl_point from = camera.view.at;
    for (int i = 0; i < 4; i++) {
        camera.view.at = (sl_point){from.x + by * sides[i][0], from.y + by * sides[i][1]};
        if (camera_has_ground(view, camera.view.at)) break;
        camera.view.at = from;
    }
    camera.name = NULL;
    add_row(view, &camera);
}

void camera_rename(view_state *view, const char *name) {
    if (!camera_chosen(view)) return;
    char *copy = *name ? sl_copy_text(view->context, name, strlen(name)) : NULL;
    if (*name && !copy) {
        view_check(view, SL_NO_MEMORY);
        return;
    }
    camera_keep(view);
    sl_camera *camera = &view->cameras->table.items[view->cameras->chosen];
    sl_free(view->context, camera->name);
    camera->name = copy;
    camera_changed(view);
}

void camera_delete(view_state *view) {
    camera_layer *layer = view->cameras;
    if (!camera_chosen(view)) return;
    camera_keep(view);
    sl_free(view->context, layer->table.items[layer->chosen].name);
    layer->table.count--;
    memmove(layer->table.items + layer->chosen, layer->table.items + layer->chosen + 1,
            (layer->table.count - layer->chosen) * sizeof *layer->table.items);
    layer->chosen = SIZE_MAX;
    camera_changed(view);
}

void camera_choose(view_state *view, int by) {
    camera_layer *layer = cameras_of(view);
    if (!layer || !layer->table.count) {
        ui_say(view->ui, false, "no camera is there yet: a click puts one");
        return;
    }
    const size_t count = layer->table.count, first = by > 0 ? 0 : count - 1;
    layer->chosen = layer->chosen >= count ? first : (layer->chosen + count + (size_t)by) % count;
}

/// The chosen camera, kept for undo before it changes; NULL: none.
static sl_viewpoint *begin_change(view_state *view) {
    if (!camera_chosen(view)) {
        ui_say(view->ui, false, "choose a camera first: click on it");
        return NULL;
    }
    camera_keep(view);
    camera_changed(view);
    return camera_chosen(view);
}

static double whole_turn(double heading) {
    return fmod(fmod(heading, 360) + 360, 360);
}

void camera_turn(view_state *view, double degrees) {
    sl_viewpoint *v = begin_change(view);
    if (v) v->heading = whole_turn(v->heading + degrees);
}

void camera_widen(view_state *view, double degrees) {
    if (!begin_change(view)) return;
    const sl_camera *row = camera_chosen_row(view);
    camera_tilt(view, fmin(fmax(row->view.fov + degrees, 5), 360), row->height, row->tilt);
}

void camera_tilt(view_state *view, double fov, double height, double tilt) {
    sl_camera *row = camera_chosen_row(view);
    sl_viewpoint ground = {.fov = row->view.fov};
    sl_viewpoint_tilt(&ground, row->height, row->tilt, SL_PICTURE_ASPECT);
    if (ground.range > 0 && row->view.range == ground.range) row->view.range = 0;
    if (row->height > 0 || height > 0) row->view.nearest = 0;
    row->view.fov = view->cameras->like.fov = fov;
    row->height = height;
    row->tilt = tilt;
    camera_range(view, row->view.range);
}

void camera_range(view_state *view, double range) {
    sl_camera *row = camera_chosen_row(view);
    row->view.range = range;
    sl_viewpoint_tilt(&row->view, row->height, row->tilt, SL_PICTURE_ASPECT);
    camera_changed(view);
}

void camera_reach(view_state *view, double factor) {
    sl_viewpoint *v = begin_change(view);
    if (!v) return;
    const double most = range_most(view->document);
    double range = (v->range > 0 ? v->range : most) * factor;
    range = range >= most ? 0 : fmax(range, 1e-3 * most);
    view->cameras->like.range = range;
    camera_range(view, range);
}

void cameras_replace(view_state *view, sl_cameras *table) {
    camera_layer *layer = cameras_of(view);
    if (layer) {
        camera_keep(view);
        sl_cameras_destroy(view->context, &layer->table);
        layer->table = *table;
        *table = (sl_cameras){0};
        layer->chosen = SIZE_MAX;
        camera_changed(view);
    }
    sl_cameras_destroy(view->context, table);
}

sl_status cameras_read(view_state *view, const char *path) {
    const sl_viewpoint like = {.fov = 360};
    sl_cameras table = {0};
    SL_TRY(sl_cameras_read(view->context, path, &like, &table));
    cameras_replace(view, &table);
    if (!view->cameras) return SL_OK;
    view->cameras->saved = view->cameras->stamp;
    size_t outside = 0;
    char say[CAMERAS_NAMED * (CAMERA_NAME + 2) + 96], name[CAMERA_NAME];
    const size_t count = view->cameras->table.count;
    int used = snprintf(say, sizeof say, "%zu camera%s read", count, count == 1 ? "" : "s");
    for (size_t i = 0; i < count; i++) {
        if (camera_has_ground(view, view->cameras->table.items[i].view.at)) continue;
        camera_name(view->cameras, i, name);
        if (outside++ < CAMERAS_NAMED)
            used += snprintf(say + used, sizeof say - (size_t)used, "%s %s",
                             outside > 1 ? "," : ";", name);
    }
    if (outside > CAMERAS_NAMED)
        used += snprintf(say + used, sizeof say - (size_t)used, " and %zu more",
                         outside - CAMERAS_NAMED);
    ui_say(view->ui, false, "%s%s", say,
           outside > 1 ? " stand in no room: drag them into one"
           : outside   ? " stands in no room: drag it into one"
                       : "");
    return SL_OK;
}

size_t cameras_unsaved(const view_state *view) {
    const camera_layer *layer = view->cameras;
    return layer && layer->saved != layer->stamp ? layer->table.count : 0;
}

sl_status cameras_write(view_state *view, const char *path) {
    if (!view->cameras || !view->cameras->table.count)
        return sl_fail(view->context, SL_BAD_ARGUMENT, "there are no cameras to be written");
    SL_TRY(sl_cameras_write(view->context, &view->cameras->table, path));
    view->cameras->saved = view->cameras->stamp;
    ui_say(view->ui, false, "%zu camera%s written to %s", view->cameras->table.count,
           view->cameras->table.count == 1 ? "" : "s", path);
    return SL_OK;
}

// --- by pointer

/// The handle of the chosen camera, ahead of it; false for one that looks all round.
static bool find_handle(const view_state *view, sl_point *at) {
    const sl_viewpoint *v = camera_chosen(view);
    if (!v || v->fov >= 360) return false;
    const double reach = 44 * ui_scale(view->ui) / view->camera.scale;
    *at = (sl_point){v->at.x + reach * cos(v->heading / DEGREES),
                     v->at.y + reach * sin(v->heading / DEGREES)};
    return true;
}

static bool is_near(const view_state *view, sl_point a, sl_point b, double reach) {
    return hypot(a.x - b.x, a.y - b.y) <= reach * grid_reach(view);
}

bool camera_take(view_state *view, drag_state *drag) {
    camera_layer *layer = view->cameras;
    sl_point handle;
    if (!layer) return false;
    if (find_handle(view, &handle) && is_near(view, handle, drag->at, 1.4)) {
        drag->part = PART_HANDLE;
        drag->index = (uint32_t)layer->chosen;
        return true;
    }
    for (size_t i = layer->table.count; i-- > 0;) {
        if (!is_near(view, layer->table.items[i].view.at, drag->at, 1.6)) continue;
        layer->chosen = i;
        drag->part = PART_BODY;
        drag->index = (uint32_t)i;
        return true;
    }
    return false;
}

void camera_move(view_state *view, drag_state *drag, sl_point now) {
    camera_layer *layer = view->cameras;
    if (!layer || drag->index >= layer->table.count) return;
    if (drag->part == PART_BODY && !camera_has_ground(view, now)) return; // it stays in the room
    if (!drag->changed) camera_keep(view);
    drag->changed = true;
    sl_viewpoint *v = &layer->table.items[drag->index].view;
    if (drag->part == PART_BODY)
        v->at = now;
    else
        v->heading = whole_turn(DEGREES * atan2(now.y - v->at.y, now.x - v->at.x));
    camera_changed(view);
}

// --- what they see

bool cameras_are_seen(const view_state *view) {
    const camera_layer *layer = view->cameras;
    return layer && layer->known && layer->seen_stamp == layer->stamp;
}

void camera_go_to_spot(view_state *view, uint32_t spot) {
    camera_layer *layer = view->cameras;
    if (!layer || !layer->known || !layer->coverage.blind_count) {
        ui_say(view->ui, false, "no blind spot is left");
        return;
    }
    spot %= layer->coverage.blind_count;
    const sl_blind_spot *blind = &layer->coverage.blind[spot];
    const sl_box plan = view->plan[0];
    const double wide = blind->bounds.max.x - blind->bounds.min.x;
    const double high = blind->bounds.max.y - blind->bounds.min.y;
    const double fits =
        0.3 * fmin(box_width(plan) / fmax(wide, 1e-100), box_height(plan) / fmax(high, 1e-100));
    view_pan(view, 0, 0);
    view->camera.scale =
        fmin(fmax(fmin(fits, 32 * view->camera.least), view->camera.least), view->camera.most);
    view->camera.middle = blind->at;
    layer->spot = spot + 1;
}

// --- the picture

/// What is drawn of the coverage: that of the last survey, while the next one is made.
static sl_drawn_coverage drawn_coverage(const camera_layer *layer) {
    return (sl_drawn_coverage){.pieces = &layer->coverage.overlay.pieces,
                               .counts = layer->coverage.overlay.counts,
                               .regions = layer->coverage.regions,
                               .count = layer->coverage.count};
}

void cameras_draw_below(view_state *view, const sl_frame *frame) {
    const camera_layer *layer = view->cameras;
    if (!layer || !layer->known) return;
    const sl_drawn_coverage drawn = drawn_coverage(layer);
    const sl_palette *palette = &view->ui->palette;
    cairo_t *cairo = view->ui->cairo;
    cairo_save(cairo);
    cairo_set_antialias(cairo, CAIRO_ANTIALIAS_NONE); // borders, drawn over them, are smooth
    view_check(view, sl_draw_coverage_areas(view->context, cairo, palette, &drawn, frame));
    cairo_restore(cairo);
    sl_draw_coverage_borders(cairo, palette, &drawn, frame);
}

static void draw_chosen(const view_state *view, const sl_frame *frame) {
    const sl_viewpoint *v = camera_chosen(view);
    const double unit = frame->unit;
    sl_point handle;
    if (!v) return;
    sl_draw_ring(view->ui->cairo, frame, v->at, 13 * unit, view->ui->palette.ink, 2.2 * unit);
    if (!find_handle(view, &handle)) return;
    const sl_colour colour = sl_viewpoint_colour(&view->ui->palette, view->cameras->chosen);
    sl_draw_line(view->ui->cairo, frame, v->at, handle, colour, 1.5 * unit);
    view_mark(view, frame, handle);
}

void cameras_draw_above(view_state *view, const sl_frame *frame) {
    const camera_layer *layer = view->cameras;
    if (!layer) return;
    sl_point blind[SPOTS_DRAWN];
    sl_drawn_coverage drawn = {.count = layer->table.count, .blind = blind};
    for (; layer->known && drawn.blind_count < layer->coverage.blind_count &&
           drawn.blind_count < SPOTS_DRAWN;
         drawn.blind_count++)
        blind[drawn.blind_count] = layer->coverage.blind[drawn.blind_count].at;
    sl_viewpoint *viewpoints =
        sl_alloc_array(view->context, layer->table.count, sizeof *viewpoints);
    const char **names = sl_alloc_array(view->context, layer->table.count, sizeof *names);
    for (size_t i = 0; viewpoints && names && i < layer->table.count; i++) {
        viewpoints[i] = layer->table.items[i].view;
        names[i] = layer->table.items[i].name;
    }
    drawn.viewpoints = viewpoints;
    drawn.names = names;
    draw_chosen(view, frame);
    if (viewpoints && names)
        view_check(view, sl_draw_coverage_marks(view->context, view->ui->cairo, &view->ui->palette,
                                                &drawn, frame));
    else
        view_check(view, SL_NO_MEMORY);
    sl_free(view->context, viewpoints);
    sl_free(view->context, (void *)names);
}
