/// PNG pictures that are written in the background.
///
/// A picture is drawn in the main thread, since that changes the state of the app. What takes long
/// is to compress and to write it: that is the work of a task, which owns the surface. Lines of
/// .svg and .pdf are recorded, and drawn once more by the task. Of a series, as many pictures are
/// in the making as there are writers; frames of the window go on between them.
#include "document/export.h"

#include "app/app.h"
#include "document/save.h"
#include "document/task.h"
#include "sightline/support.h"

#include <errno.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>

enum { WRITERS = 2, EXPORT_PATH = 4096 };

typedef struct writer {
    task *task; ///< NULL: it is free
    char path[EXPORT_PATH];
    cairo_surface_t *surface; ///< the task's, until it ends
    int width, height;
} writer;

struct export_job {
    writer writers[WRITERS];
    char folder[EXPORT_PATH - 32]; ///< of a series; empty for a single picture
    char said[256];
    unsigned every, number, total; ///< of pictures: the number of those taken
    size_t next;                   ///< frame of the recording
    int free;                      ///< the writer of the picture that is taken in this frame, or -1
    bool draws;
};

// --- in the thread

static void paint(void *user, cairo_t *cairo) {
    cairo_set_source_surface(cairo, ((writer *)user)->surface, 0, 0);
    cairo_paint(cairo);
}

static sl_status write_picture(sl_context *context, void *data) {
    writer *w = data;
    SL_TRY(sl_check_cancelled(context));
    return sl_draw_page_file(context, w->path, w->width, w->height, "Sightline", paint, w);
}

// --- a picture

static sl_status begin(app_state *app, writer *w, const char *path, int width, int height,
                       void (*draw)(void *user, cairo_t *cairo)) {
    export_job *job = app->exports;
    w->width = width;
    w->height = height;
    snprintf(w->path, sizeof w->path, "%s", path);
    w->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    cairo_t *cairo = cairo_create(w->surface);
    sl_context *const drawing = app->view.drawing;
    job->draws = true;
    app->view.drawing = NULL; // it is drawn to its end
    draw(app, cairo);
    app->view.drawing = drawing;
    job->draws = false;
    const cairo_status_t drawn = cairo_status(cairo);
    cairo_destroy(cairo);
    const sl_status status =
        drawn ? sl_fail(app->context, drawn == CAIRO_STATUS_NO_MEMORY ? SL_NO_MEMORY : SL_IO,
                        "%s: cannot draw: %s", path, cairo_status_to_string(drawn))
              : task_start(app->context, write_picture, w, NULL, NULL, &w->task);
    if (status != SL_OK) cairo_surface_destroy(w->surface);
    return status;
}

/// Waits for a picture.
static sl_status finish(sl_context *context, writer *w) {
    if (!w->task) return SL_OK;
    const sl_status status = task_end(context, w->task);
    cairo_surface_destroy(w->surface);
    w->task = NULL;
    return status;
}

// --- the job

static bool is_series(const export_job *job) {
    return job->folder[0] != '\0';
}

/// Waits for the writers, tells of the first failure, and ends the job.
static sl_status end(app_state *app) {
    export_job *job = app->exports;
    sl_status status = SL_OK;
    for (int i = 0; i < WRITERS; i++) {
        const sl_status one = finish(app->context, &job->writers[i]);
        if (status == SL_OK) status = one;
    }
    app->exports = NULL;
    sl_free(app->context, job);
    return status;
}

/// Cancels the writers, and ends the job.
static void stop(app_state *app) {
    for (int i = 0; i < WRITERS; i++)
        if (app->exports->writers[i].task) task_cancel(app->exports->writers[i].task);
    end(app);
}

static sl_status start(app_state *app, export_job **out) {
    export_job *job = sl_alloc_array(app->context, 1, sizeof *job);
    if (!job) return SL_NO_MEMORY;
    job->free = -1;
    *out = app->exports = job;
    return SL_OK;
}

bool export_is_free(app_state *app) {
    if (!app->exports) return true;
    if (is_series(app->exports)) return false;
    view_check(&app->view, end(app));
    return true;
}

sl_status export_plan(app_state *app, const char *path, const char *said) {
    export_job *job;
    const sl_box plan = app_layout(app).plan[0];
    if (!export_is_free(app))
        return sl_fail(app->context, SL_BAD_ARGUMENT, "pictures are being written; Esc stops that");
    SL_TRY(start(app, &job));
    snprintf(job->said, sizeof job->said, "%s", said);
    job->total = job->number = 1;
    const sl_status status = begin(app, &job->writers[0], path, (int)box_width(plan),
                                   (int)box_height(plan), save_draw_plan);
    if (status != SL_OK) end(app);
    return status;
}

sl_status export_series(app_state *app, const char *folder, unsigned every) {
    path_recorder *r = &app->recorder;
    export_job *job;
    if (!export_is_free(app))
        return sl_fail(app->context, SL_BAD_ARGUMENT, "pictures are being written; Esc stops that");
    if (!r->frames.count)
        return sl_fail(app->context, SL_BAD_ARGUMENT, "nothing was recorded to be exported");
    if (mkdir(folder, 0777) != 0 && errno != EEXIST)
        return sl_fail(app->context, SL_IO, "%s: %s", folder, strerror(errno));
    SL_TRY(start(app, &job));
    r->records = r->plays = false;
    job->every = every ? every : 1;
    job->total = (unsigned)((r->frames.count + job->every - 1) / job->every);
    snprintf(job->folder, sizeof job->folder, "%s", folder);
    return SL_OK;
}

void export_move(app_state *app) {
    export_job *job = app->exports;
    const path_recorder *r = &app->recorder;
    if (!job) return;
    job->free = -1;
    if (!is_series(job) || job->next >= r->frames.count || r->records) return;
    for (int i = 0; i < WRITERS; i++)
        if (!job->writers[i].task) job->free = i;
    if (job->free < 0) return;
    app->view.eye.at = r->frames.items[job->next].at;
    app->view.eye.heading = r->frames.items[job->next].heading;
}

static sl_status take(app_state *app) {
    export_job *job = app->exports;
    char path[EXPORT_PATH];
    job->next += job->every;
    snprintf(path, sizeof path, "%s/frame-%04u.png", job->folder, ++job->number);
    return begin(app, &job->writers[job->free], path, app->ui.width, app->ui.height,
                 save_draw_window);
}

void export_take(app_state *app) {
    export_job *job = app->exports;
    if (!job) return;
    sl_status status = job->free >= 0 ? take(app) : SL_OK;
    job->free = -1;
    bool any = false;
    for (int i = 0; i < WRITERS; i++) {
        writer *w = &job->writers[i];
        if (w->task && task_done(w->task) && status == SL_OK) status = finish(app->context, w);
        any |= w->task != NULL;
    }
    const path_recorder *r = &app->recorder;
    const bool more = is_series(job) && job->next < r->frames.count && !r->records;
    if (status == SL_OK && (any || more)) return;
    char said[sizeof job->said + sizeof job->folder];
    if (is_series(job))
        snprintf(said, sizeof said, "%u pictures in %s", job->number, job->folder);
    else
        snprintf(said, sizeof said, "%s", job->said);
    // A failure ends the rest.
    if (status != SL_OK) {
        char message[sizeof app->ui.message];
        snprintf(message, sizeof message, "%s", sl_context_message(app->context));
        stop(app);
        ui_say(&app->ui, true, "%s", message);
    } else {
        status = end(app);
        if (status == SL_OK) ui_say(&app->ui, false, "%s", said);
        view_check(&app->view, status);
    }
}

bool export_stop(app_state *app) {
    if (!app->exports) return false;
    stop(app);
    return true;
}

job_progress export_progress(const export_job *job) {
    if (!job || job->draws) return (job_progress){0};
    unsigned open = 0;
    for (int i = 0; i < WRITERS; i++) open += job->writers[i].task != NULL;
    return (job_progress){
        .running = true,
        .stage = "write pictures",
        .share = is_series(job) && job->total ? (double)(job->number - open) / job->total : -1};
}
