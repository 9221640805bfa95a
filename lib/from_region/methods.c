#include "from_region/methods.h"

#include <string.h>

// --- looking

sl_status sl_from_region_look(sl_context *context, const sl_from_region_work *work,
                              sl_from_region_thread *thread, uint32_t face, int quadrant,
                              const sl_bits *refine, sl_bits *seen) {
    for (int q = 0; q < SL_QUADRANTS; q++) {
        if ((quadrant >= 0 && q != quadrant) || !sl_face_faces(work->scene, face, q)) continue;
        const sl_from_region_query query = {&work->scene->faces.items[face], q, refine};
        SL_TRY(work->looker->look(context, thread->looker, &query, seen, &thread->account));
    }
    return SL_OK;
}

static void end(sl_context *context, void *job, void *state) {
    sl_from_region_work *work = job;
    sl_from_region_thread *me = state;
    pthread_mutex_lock(&work->lock);
    work->account.images += me->account.images;
    work->account.rays += me->account.rays;
    work->account.refined += me->account.refined;
    work->candidates += me->candidates;
    work->relations += me->relations;
    pthread_mutex_unlock(&work->lock);
    work->looker->destroy(context, me->looker);
    sl_free(context, me->set);
    sl_free(context, me->refine);
    sl_free(context, me);
}

static sl_status begin(sl_context *context, void *job, void **state) {
    sl_from_region_work *work = job;
    sl_from_region_thread *me = sl_alloc_array(context, 1, sizeof *me);
    if (!me) return SL_NO_MEMORY;
    me->set = sl_alloc_array(context, work->scene->words, sizeof *me->set);
    me->refine = sl_alloc_array(context, work->scene->words, sizeof *me->refine);
    sl_status status = me->set && me->refine ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK)
        status = work->looker->create(context, work->scene, work->options, &me->looker);
    if (status == SL_OK)
        *state = me;
    else
        end(context, job, me);
    return status;
}

static sl_status run_unit(sl_context *context, void *job, void *state, size_t unit) {
    sl_from_region_work *work = job;
    return work->unit(context, work, state, unit);
}

sl_status sl_from_region_run(sl_context *context, sl_from_region_work *work, size_t count,
                             const size_t *after) {
    const sl_work threads = {
        .job = work,
        .begin = begin,
        .unit = run_unit,
        .end = end,
        .leave_thread = work->options->solver->stabs ? work->options->stab->leave_thread : NULL,
        .stage = "from_region",
        .units = "steps",
        .after = after};
    return sl_work_run(context, &threads, count, work->options->threads);
}

// --- brute force

/// A view cell on its own: all objects from all of its faces.
static sl_status brute_unit(sl_context *context, sl_from_region_work *work,
                            sl_from_region_thread *thread, size_t unit) {
    const sl_regions *scene = work->scene;
    sl_bits *row = work->seen + unit * scene->words;
    for (uint32_t face = scene->first_face[unit]; face < scene->first_face[unit + 1]; face++)
        SL_TRY(sl_from_region_look(context, work, thread, face, -1, work->all, row));
    thread->candidates += SL_QUADRANTS * (uint64_t)sl_regions_objects(scene);
    sl_row_or(row, sl_regions_inside(scene, (uint32_t)unit), scene->words);
    return SL_OK;
}

static sl_status brute(sl_context *context, sl_from_region_work *work) {
    work->unit = brute_unit;
    return sl_from_region_run(context, work, work->scene->counts.view_cells, NULL);
}

// --- options, results, the tables

sl_from_region_options sl_from_region_options_default(void) {
    size_t count;
    return (sl_from_region_options){.solver = &sl_from_region_solvers(&count)[0],
                                    .sight = SL_CLOSED,
                                    .points = 256,
                                    .pixels = 32,
                                    .seed = 1};
}

const sl_from_region_solver *sl_from_region_solvers(size_t *count) {
    static const sl_from_region_solver solvers[] = {
        {.name = "sampling",
         .what = "lines from points of the faces, half a quadrant rasterised at a time",
         .guarantee = SL_AGGRESSIVE},
        {.name = "stabs",
         .what = "stab trees within the quadrant, by a stabbing solver",
         .guarantee = SL_EXACT,
         .stabs = true},
    };
    *count = sizeof solvers / sizeof *solvers;
    return solvers;
}

void sl_from_region_result_destroy(sl_context *context, sl_from_region_result *result) {
    sl_free(context, result->seen);
    *result = (sl_from_region_result){0};
}

bool sl_from_region_sees(const sl_from_region_result *result, uint32_t view_cell, uint32_t object) {
    return sl_bits_has(result->seen + (size_t)view_cell * result->words, object);
}

uint64_t sl_from_region_pairs(const sl_from_region_result *result) {
    return sl_row_count(result->seen, (size_t)result->view_cells * result->words);
}

static sl_status check_options(sl_context *context, const sl_from_region_options *options) {
    if (!options->solver) return sl_fail(context, SL_BAD_ARGUMENT, "no solver");
    if (options->solver->stabs && !(options->stab && options->stab->toward))
        return sl_fail(context, SL_BAD_ARGUMENT, "the solver '%s' needs a stabbing solver",
                       options->solver->name);
    if (options->points < 1 || options->points > 1u << 20)
        return sl_fail(context, SL_BAD_ARGUMENT, "%u points: 1 to 1048576", options->points);
    if (options->pixels < 1 || options->pixels > 1u << 16)
        return sl_fail(context, SL_BAD_ARGUMENT, "%u pixels: 1 to 65536", options->pixels);
    return SL_OK;
}

/// Occluders that are no objects are left out of the rows.
static void fill(const sl_from_region_work *work, sl_from_region_result *out) {
    const sl_regions *scene = work->scene;
    const uint32_t objects = scene->counts.objects;
    for (uint32_t i = 0; i < scene->counts.view_cells && scene->occluders; i++) {
        sl_bits *row = work->seen + i * scene->words;
        for (uint32_t k = objects; k < sl_regions_objects(scene); k++)
            row[k / 64] &= ~((sl_bits)1 << (k % 64));
    }
    *out = (sl_from_region_result){.view_cells = scene->counts.view_cells,
                                   .objects = objects,
                                   .words = (uint32_t)scene->words,
                                   .seen = work->seen,
                                   .images = work->account.images,
                                   .rays = work->account.rays,
                                   .refined = work->account.refined,
                                   .candidates = work->candidates,
                                   .relations = work->relations};
}

static sl_status see(sl_context *context, const sl_regions *scene,
                     const sl_from_region_options *options,
                     sl_status (*method)(sl_context *, sl_from_region_work *),
                     sl_from_region_result *out) {
    SL_TRY(check_options(context, options));
    sl_from_region_work work = {.scene = scene,
                                .options = options,
                                .looker = options->solver->stabs ? sl_from_region_stabs()
                                                                 : sl_from_region_sampling()};
    work.all = sl_alloc_array(context, scene->words, sizeof *work.all);
    work.seen = sl_alloc_array(context, scene->counts.view_cells, scene->words * sizeof(sl_bits));
    pthread_mutex_init(&work.lock, NULL);
    sl_status status = work.all && work.seen ? SL_OK : SL_NO_MEMORY;
    for (uint32_t i = 0; i < sl_regions_objects(scene) && status == SL_OK; i++)
        sl_bits_add(work.all, i);
    if (status == SL_OK) status = method(context, &work);
    pthread_mutex_destroy(&work.lock);
    sl_free(context, work.all);
    if (status == SL_OK)
        fill(&work, out);
    else
        sl_free(context, work.seen);
    return status;
}

static sl_status see_brute(sl_context *context, const sl_regions *scene,
                           const sl_from_region_options *options, sl_from_region_result *out) {
    return see(context, scene, options, brute, out);
}

static sl_status see_hierarchy(sl_context *context, const sl_regions *scene,
                               const sl_from_region_options *options, sl_from_region_result *out) {
    return see(context, scene, options, sl_from_region_hierarchy, out);
}

static sl_status see_multipass(sl_context *context, const sl_regions *scene,
                               const sl_from_region_options *options, sl_from_region_result *out) {
    return see(context, scene, options, sl_from_region_multipass, out);
}

const sl_from_region_method *sl_from_region_methods(size_t *count) {
    static const sl_from_region_method methods[] = {
        {"brute", "every view cell on its own, among all objects", see_brute},
        {"hierarchy", "view cells divided, what lies between two halves among what both see",
         see_hierarchy},
        {"multipass", "each view cell among what those behind it see, quadrant by quadrant",
         see_multipass},
    };
    *count = sizeof methods / sizeof *methods;
    return methods;
}
