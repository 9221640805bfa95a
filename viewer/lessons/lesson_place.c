/// The lesson of the exact method for the fewest cameras: bounds that close in, the witnesses that
/// the lower bound asks to be seen, the places that see the largest sets of them, and the cameras.
///
/// The bounds are those of the run. Witnesses and places are those of the last lower bound. A run
/// that takes too long is stopped, and shows the bounds that it has.
#include "lessons/learn.h"
#include "plan/layers.h"
#include "sightline/draw.h"
#include "sightline/support.h"

#include <inttypes.h>
#include <stdio.h>

/// The lesson waits for no longer than this.
#define SECONDS 1.0

/// Places with many witnesses are shown, up to so many.
enum { PLACES_MOST = 60 };

// --- the run

typedef struct run {
    lesson_state *lesson;
    sl_context *context;
    double until;
    sl_status status;
} run;

static bool is_late(void *user) {
    const run *r = user;
    return sl_seconds() > r->until;
}

static void take_bounds(void *user, const sl_progress *progress) {
    run *r = user;
    lesson_state *lesson = r->lesson;
    const size_t count = lesson->bounds.count;
    const lesson_bounds now = {progress->done, progress->total};
    const lesson_bounds *last = count ? &lesson->bounds.items[count - 1] : NULL;
    if (last && last->lower == now.lower && last->upper == now.upper) return;
    r->status = SL_ARRAY_ROOM(r->context, &lesson->bounds, 1);
    if (r->status == SL_OK) lesson->bounds.items[lesson->bounds.count++] = now;
}

static sl_status place(run *r, const sl_baked *baked) {
    lesson_state *lesson = r->lesson;
    sl_query *query = NULL;
    const sl_hooks hooks = {.user = r, .progress = take_bounds, .cancelled = is_late};
    sl_context *hurried = sl_context_create(&hooks);
    if (!hurried) return SL_NO_MEMORY;
    r->until = sl_seconds() + SECONDS;
    sl_status status = sl_query_over(hurried, &baked->space, &baked->map, NULL, &query);
    if (status == SL_OK) status = sl_place(hurried, query, NULL, &lesson->placement);
    lesson->hurried = status == SL_CANCELLED;
    if (status != SL_OK && status != SL_CANCELLED)
        snprintf(lesson->refused, SENTENCE, "%s.", sl_context_message(hurried));
    else if (!lesson->placement.count)
        snprintf(lesson->refused, SENTENCE, "This map is too large to be done while you wait.");
    sl_query_destroy(hurried, query);
    sl_context_destroy(hurried);
    return status == SL_NO_MEMORY ? status : r->status;
}

static sl_status record(sl_context *context, lesson_state *lesson, const document_state *document,
                        uint32_t source) {
    (void)source;
    lesson->refused[0] = '\0';
    run r = {.lesson = lesson, .context = context};
    return place(&r, document->baked);
}

// --- steps: bounds, witnesses, places, the cameras

typedef struct step {
    enum { BOUNDS, WITNESS, PLACE, CAMERAS } part;
    size_t number;
} step;

static uint32_t shown_places(const lesson_state *lesson) {
    const uint32_t count = lesson->placement.columns.column_count;
    return count < PLACES_MOST ? count : PLACES_MOST;
}

static size_t length(const lesson_state *lesson) {
    if (lesson->refused[0]) return 1;
    return lesson->bounds.count + lesson->placement.witness_count + shown_places(lesson) + 1;
}

static step step_of(const lesson_state *lesson) {
    size_t at = lesson->at;
    const size_t counts[] = {lesson->bounds.count, lesson->placement.witness_count,
                             shown_places(lesson)};
    for (int part = BOUNDS; part < CAMERAS; part++) {
        if (at < counts[part]) return (step){part, at};
        at -= counts[part];
    }
    return (step){CAMERAS, 0};
}

/// The witnesses that the place of a column sees: entries from *first on.
static uint32_t seen_from(const lesson_state *lesson, size_t column, size_t *first) {
    const sl_cover_problem *c = &lesson->placement.columns;
    *first = column ? c->ends[column - 1] : 0;
    return (uint32_t)(c->ends[column] - *first);
}

static void say_cameras(const lesson_state *lesson, char text[SENTENCE]) {
    const sl_placement *p = &lesson->placement;
    if (p->lower == p->upper)
        snprintf(text, SENTENCE,
                 "%" PRIu64 " cameras see everything, and the %u witnesses need as many: no fewer "
                 "can.",
                 p->upper, p->witness_count);
    else
        snprintf(text, SENTENCE,
                 "%" PRIu64 " cameras see everything, and at least %" PRIu64 " are needed.%s",
                 p->upper, p->lower,
                 lesson->hurried ? " The lesson stopped there; the Cameras mode goes on." : "");
}

static void say(const lesson_state *lesson, const document_state *document, char text[SENTENCE]) {
    (void)document;
    const step s = step_of(lesson);
    size_t first;
    if (lesson->refused[0])
        snprintf(text, SENTENCE, "%s", lesson->refused);
    else if (s.part == BOUNDS)
        snprintf(text, SENTENCE,
                 "The bounds close in: at least %" PRIu64 " cameras, and %" PRIu64 " are enough.",
                 lesson->bounds.items[s.number].lower, lesson->bounds.items[s.number].upper);
    else if (s.part == WITNESS)
        snprintf(text, SENTENCE,
                 "Witness %zu must be seen, so a camera must stand where it can be seen from: in "
                 "the region "
                 "that is drawn.",
                 s.number + 1);
    else if (s.part == PLACE)
        snprintf(text, SENTENCE,
                 "Such regions meet in a place that sees %u of the %u witnesses. Each set of "
                 "witnesses that "
                 "one place sees is part of one of these.",
                 seen_from(lesson, s.number, &first), lesson->placement.witness_count);
    else
        say_cameras(lesson, text);
}

static const char *const lines[] = {
    "witnesses = some points inside",
    "repeat:",
    "    places = corners where views of witnesses meet",
    "    lower = the fewest places that see all witnesses",
    "    upper = the fewest places tried that see everything",
    "    until lower = upper:",
    "        new witnesses where something is not seen",
};

static const char *const *code(const lesson_state *lesson, const document_state *document,
                               size_t *count, size_t *lit) {
    static const size_t lines_of[] = {[BOUNDS] = 5, [WITNESS] = 0, [PLACE] = 2, [CAMERAS] = 4};
    (void)document;
    *count = sizeof lines / sizeof *lines;
    *lit = lines_of[step_of(lesson).part];
    return lines;
}

static void account(const lesson_state *lesson, char text[SENTENCE]) {
    const sl_placement *p = &lesson->placement;
    snprintf(text, SENTENCE,
             "%u witnesses, %u largest sets of them that one place sees; %" PRIu64 " to %" PRIu64
             " cameras.",
             p->witness_count, p->columns.column_count, p->lower, p->upper);
}

// --- the picture

static void draw_witness(learn_state *learn, const sl_frame *frame, sl_point at, bool marked) {
    const sl_palette *palette = &learn->ui->palette;
    sl_draw_ring(learn->ui->cairo, frame, at, 3 * frame->unit,
                 marked ? palette->start : palette->ink, (marked ? 5 : 2) * frame->unit);
}

static void draw_views(learn_state *learn, const sl_frame *frame, size_t column) {
    const sl_placement *p = &learn->lesson.placement;
    const sl_colour colour = sl_viewpoint_colour(&learn->ui->palette, column);
    size_t first;
    const uint32_t count = seen_from(&learn->lesson, column, &first);
    for (uint32_t i = 0; i < count; i++)
        sl_draw_line(learn->ui->cairo, frame, p->places[column],
                     p->witnesses[p->columns.entries[first + i]].at, colour, 1.6 * frame->unit);
    sl_draw_ring(learn->ui->cairo, frame, p->places[column], 8 * frame->unit, colour,
                 3 * frame->unit);
}

/// What a witness sees: where a camera has to stand.
static void below(learn_state *learn, const sl_frame *frame) {
    const lesson_state *lesson = &learn->lesson;
    const step s = step_of(lesson);
    if (lesson->refused[0] || s.part != WITNESS || !learn->view->present.query) return;
    sl_region region = {0};
    const sl_view view = sl_view_all_round(lesson->placement.witnesses[s.number].at);
    const sl_status status =
        sl_query_region(learn->context, learn->view->present.query, &view, &region);
    view_check(learn->view, status);
    if (status == SL_OK) layers_draw_region(learn->view, frame, &region, TONE_REGION, true);
    sl_region_destroy(learn->context, &region);
}

static void above(learn_state *learn, const sl_frame *frame) {
    const lesson_state *lesson = &learn->lesson;
    const sl_placement *p = &lesson->placement;
    const step s = step_of(lesson);
    if (lesson->refused[0]) return;
    for (uint32_t i = 0; i < p->witness_count; i++)
        draw_witness(learn, frame, p->witnesses[i].at, s.part == WITNESS && s.number == i);
    if (s.part == PLACE) draw_views(learn, frame, s.number);
    if (s.part != CAMERAS) return;
    const sl_drawn_coverage drawn = {.viewpoints = p->viewpoints, .count = p->count};
    view_check(learn->view, sl_draw_coverage_marks(learn->context, learn->ui->cairo,
                                                   &learn->ui->palette, &drawn, frame));
}

/// The first step of each part.
static bool finds(const lesson_state *lesson, size_t at) {
    if (lesson->refused[0]) return false;
    const size_t witnesses = lesson->bounds.count;
    const size_t places = witnesses + lesson->placement.witness_count;
    return at == witnesses || at == places || at == places + shown_places(lesson);
}

const subject_row lesson_place = {
    .title = "The fewest cameras",
    .record = record,
    .length = length,
    .sentence = say,
    .code = code,
    .account = account,
    .finds = finds,
    .found = "Part",
    .below = below,
    .above = above,
};
