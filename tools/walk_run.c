#include "walk_run.h"

#include "isovist_run.h"
#include "walk_draw.h"

#include <math.h>

static const char *const names[SL_FIGURES] = {
    "tests",        "frustum_tests", "opened", "propagations", "propagated", "skipped", "bounded",
    "cheap",        "visited",       "out",    "invisible",    "partial",    "visible", "occluders",
    "orientations", "cells",         "walls",  "visibility_s", "drawing_s",  "frame_s",
};

const char *sl_walk_figure_name(sl_walk_figure figure) {
    return names[figure];
}

const char *sl_walk_choice_name(const sl_walk_choice *choice) {
    return choice->method ? choice->method->name : choice->baked->name;
}

const char *sl_walk_choice_test(const sl_walk_choice *choice) {
    return choice->method ? choice->options.test->name : "baked";
}

/// What one walk needs.
typedef struct running {
    const sl_walk_scene *scene;
    const sl_walk_choice *choice;
    sl_walk *walk;
    sl_eye_search *search;
    uint64_t *cells;
    sl_walk_canvas *canvas;
} running;

static sl_status start(sl_context *context, running *r) {
    const sl_space *space = &r->scene->baked->space;
    if (r->choice->method)
        return sl_walk_create(context, r->scene->hierarchy, r->choice->method, &r->choice->options,
                              &r->walk);
    r->cells = sl_alloc_array(context, sl_eye_words(space), sizeof *r->cells);
    if (!r->cells) return SL_NO_MEMORY;
    return sl_eye_search_create(context, space, &r->scene->baked->visibility, &r->search);
}

static void stop(sl_context *context, running *r) {
    sl_walk_destroy(context, r->walk);
    sl_eye_search_destroy(context, r->search);
    sl_free(context, r->cells);
    r->walk = NULL;
    r->search = NULL;
    r->cells = NULL;
}

static void put_counts(const sl_walk_frame *f, double *out) {
    const double values[] = {
        f->tests,     f->frustum_tests, f->opened,  f->propagations, f->propagated,
        f->skipped,   f->bounded,       f->cheap,   f->visited,      f->out,
        f->invisible, f->partial,       f->visible, f->occluders,    (double)f->orientations};
    for (int i = 0; i <= SL_FIGURE_ORIENTATIONS; i++) out[i] = values[i];
}

static uint32_t count_cells(const uint64_t *cells, size_t words) {
    uint32_t count = 0;
    for (size_t i = 0; i < words; i++) count += (uint32_t)__builtin_popcountll(cells[i]);
    return count;
}

/// One frame; times already there are kept where they are less.
static sl_status do_frame(sl_context *context, running *r, const sl_eye *eye, bool first,
                          double *out) {
    const sl_space *space = &r->scene->baked->space;
    const sl_view view = sl_eye_view(space, eye);
    const uint64_t *cells = r->cells;
    const double began = sl_now();
    if (r->walk) {
        sl_walk_frame frame;
        SL_TRY(sl_walk_step(context, r->walk, &view, &frame));
        cells = sl_walk_cells(r->walk);
        put_counts(&frame, out);
    } else {
        sl_eye_account account;
        SL_TRY(r->choice->baked->cull(context, r->search, &view, r->cells, &account));
        out[SL_FIGURE_ORIENTATIONS] = (double)account.orientations;
    }
    const double seen = sl_now();
    out[SL_FIGURE_WALLS] = sl_walk_draw(r->canvas, eye, cells);
    const double drawn = sl_now();
    out[SL_FIGURE_CELLS] = count_cells(cells, sl_eye_words(space));
    out[SL_FIGURE_VISIBILITY] =
        first ? seen - began : fmin(out[SL_FIGURE_VISIBILITY], seen - began);
    out[SL_FIGURE_DRAWING] = first ? drawn - seen : fmin(out[SL_FIGURE_DRAWING], drawn - seen);
    if (r->scene->wall_seconds > 0)
        out[SL_FIGURE_DRAWING] = r->scene->wall_seconds * out[SL_FIGURE_WALLS];
    out[SL_FIGURE_FRAME] = out[SL_FIGURE_VISIBILITY] + out[SL_FIGURE_DRAWING];
    return SL_OK;
}

static sl_status run_all(sl_context *context, running *r, const sl_eyes *eyes, double *frames) {
    const size_t count = eyes->list.count;
    for (unsigned k = 0; k < r->scene->repeat; k++) {
        SL_TRY(start(context, r));
        for (size_t i = 0; i < count; i++) {
            if (i % 1024 == 0) SL_TRY(sl_check_cancelled(context));
            SL_TRY(do_frame(context, r, &eyes->list.items[i], k == 0, frames + i * SL_FIGURES));
        }
        stop(context, r);
        sl_report(context, "walk", "walks", k + 1, r->scene->repeat);
    }
    return SL_OK;
}

sl_status sl_walk_run(sl_console *console, const sl_walk_scene *scene, const sl_walk_choice *choice,
                      const sl_eyes *eyes, double means[SL_FIGURES], double *frames) {
    sl_context *context = console->context;
    const size_t count = eyes->list.count;
    running r = {.scene = scene, .choice = choice};
    double *own = frames ? NULL : sl_alloc_array(context, count * SL_FIGURES, sizeof *own);
    if (!frames && !own) return SL_NO_MEMORY;
    double *all = frames ? frames : own;
    sl_status status = sl_walk_canvas_create(context, scene->hierarchy, &r.canvas);
    if (status == SL_OK) status = run_all(context, &r, eyes, all);
    stop(context, &r);
    sl_walk_canvas_destroy(context, r.canvas);
    for (int f = 0; f < SL_FIGURES && status == SL_OK; f++) {
        double sum = 0;
        for (size_t i = 0; i < count; i++) sum += all[i * SL_FIGURES + (size_t)f];
        means[f] = sum / (double)count;
    }
    sl_free(context, own);
    return status;
}
