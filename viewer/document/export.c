/// PNG pictures that are written in the background.
///
/// A picture is drawn in the main thread, since that changes the state of the app. What takes long
/// is to compress and to write it: that is the work of a task, which owns the surface. Lines of
/// .svg and .pdf are recorded, and drawn once more by the task. Of a series, as many pictures are
/// in the making as there are writers; frames of the window go on between them.
#include "document/export.h"

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
    export_draw *draw;             ///< of a series
    bool draws;
};

// --- in the thread

static void paint_surface(void *user, cairo_t *cairo) {
    cairo_set_source_surface(cairo, ((writer *)user)->surface, 0, 0);
    cairo_paint(cairo);
}

static sl_status write_picture(sl_context *context, void *data) {
    writer *w = data;
    SL_TRY(sl_check_cancelled(context));
    return sl_draw_page_file(context, w->path, w->width, w->height, "Sightline", paint_surface, w);
}

// --- a picture

static sl_status draw_picture(export_state *e, writer *w, const char *path, int width, int height,
                              export_draw *draw) {
    export_job *job = e->job;
    w->width = width;
    w->height = height;
    snprintf(w->path, sizeof w->path, "%s", path);
    w->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    cairo_t *cairo = cairo_create(w->surface);
    job->draws = true;
    draw(e->user, cairo);
    job->draws = false;
    const cairo_status_t drawn = cairo_status(cairo);
    cairo_destroy(cairo);
    const sl_status status =
        drawn ? sl_fail(e->context, drawn == CAIRO_STATUS_NO_MEMORY ? SL_NO_MEMORY : SL_IO,
                        "%s: cannot draw: %s", path, cairo_status_to_string(drawn))
              : task_start(e->context, write_picture, w, NULL, NULL, &w->task);
    if (status != SL_OK) cairo_surface_destroy(w->surface);
    return status;
}

/// Waits for a picture.
static sl_status finish_picture(sl_context *context, writer *w) {
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
static sl_status end_job(export_state *e) {
    export_job *job = e->job;
    sl_status status = SL_OK;
    for (int i = 0; i < WRITERS; i++) {
        const sl_status one = finish_picture(e->context, &job->writers[i]);
        if (status == SL_OK) status = one;
    }
    e->job = NULL;
    sl_free(e->context, job);
    return status;
}

/// Cancels the writers, and ends the job.
static void stop_job(export_state *e) {
    for (int i = 0; i < WRITERS; i++)
        if (e->job->writers[i].task) task_cancel(e->job->writers[i].task);
    end_job(e);
}

static sl_status start_job(export_state *e, export_job **out) {
    export_job *job = sl_alloc_array(e->context, 1, sizeof *job);
    if (!job) return SL_NO_MEMORY;
    job->free = -1;
    *out = e->job = job;
    return SL_OK;
}

bool export_is_free(export_state *e) {
    if (!e->job) return true;
    if (is_series(e->job)) return false;
    ui_report(e->ui, e->context, end_job(e));
    return true;
}

sl_status export_picture(export_state *e, const char *path, const char *said, int width, int height,
                         export_draw *draw) {
    export_job *job;
    if (!export_is_free(e))
        return sl_fail(e->context, SL_BAD_ARGUMENT, "pictures are being written; Esc stops that");
    SL_TRY(start_job(e, &job));
    snprintf(job->said, sizeof job->said, "%s", said);
    job->total = job->number = 1;
    const sl_status status = draw_picture(e, &job->writers[0], path, width, height, draw);
    if (status != SL_OK) end_job(e);
    return status;
}

sl_status export_series(export_state *e, const char *folder, unsigned every, export_draw *draw) {
    path_recorder *r = e->recorder;
    export_job *job;
    if (!export_is_free(e))
        return sl_fail(e->context, SL_BAD_ARGUMENT, "pictures are being written; Esc stops that");
    if (!r->frames.count)
        return sl_fail(e->context, SL_BAD_ARGUMENT, "nothing was recorded to be exported");
    if (mkdir(folder, 0777) != 0 && errno != EEXIST)
        return sl_fail(e->context, SL_IO, "%s: %s", folder, strerror(errno));
    SL_TRY(start_job(e, &job));
    r->records = r->plays = false;
    job->draw = draw;
    job->every = every ? every : 1;
    job->total = (unsigned)((r->frames.count + job->every - 1) / job->every);
    snprintf(job->folder, sizeof job->folder, "%s", folder);
    return SL_OK;
}

bool export_move(export_state *e, record_frame *at) {
    export_job *job = e->job;
    const path_recorder *r = e->recorder;
    if (!job) return false;
    job->free = -1;
    if (!is_series(job) || job->next >= r->frames.count || r->records) return false;
    for (int i = 0; i < WRITERS; i++)
        if (!job->writers[i].task) job->free = i;
    if (job->free < 0) return false;
    *at = r->frames.items[job->next];
    return true;
}

static sl_status take_next(export_state *e) {
    export_job *job = e->job;
    char path[EXPORT_PATH];
    job->next += job->every;
    snprintf(path, sizeof path, "%s/frame-%04u.png", job->folder, ++job->number);
    return draw_picture(e, &job->writers[job->free], path, e->ui->width, e->ui->height, job->draw);
}

void export_take(export_state *e) {
    export_job *job = e->job;
    if (!job) return;
    sl_status status = job->free >= 0 ? take_next(e) : SL_OK;
    job->free = -1;
    bool any = false;
    for (int i = 0; i < WRITERS; i++) {
        writer *w = &job->writers[i];
        if (w->task && task_done(w->task) && status == SL_OK)
            status = finish_picture(e->context, w);
        any |= w->task != NULL;
    }
    const path_recorder *r = e->recorder;
    const bool more = is_series(job) && job->next < r->frames.count && !r->records;
    if (status == SL_OK && (any || more)) return;
    char said[sizeof job->said + sizeof job->folder];
    if (is_series(job))
        snprintf(said, sizeof said, "%u pictures in %s", job->number, job->folder);
    else
        snprintf(said, sizeof said, "%s", job->said);
    // A failure ends the rest.
    if (status != SL_OK) {
        char message[sizeof e->ui->message];
        snprintf(message, sizeof message, "%s", sl_context_message(e->context));
        stop_job(e);
        ui_say(e->ui, true, "%s", message);
    } else {
        status = end_job(e);
        if (status == SL_OK) ui_say(e->ui, false, "%s", said);
        ui_report(e->ui, e->context, status);
    }
}

bool export_stop(export_state *e) {
    if (!e->job) return false;
    stop_job(e);
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
