/// The from-region methods: which objects are seen from which view cells? (Laine 2005, A General
/// Algorithm for Output-Sensitive Visibility Preprocessing)
///
/// All methods ask one solver the same questions: which objects of a refine set are seen through
/// this face, within this quadrant of directions? They differ in the refine set, and so in work.
///
///   brute      each view cell on its own; the refine set is all objects.
///   hierarchy  view cells are halved again and again. Faces between two halves are solved once,
///              among what the whole sees, and their sets are cached (Nirenstein & Blake 2004).
///   multipass  one pass a quadrant, view cells in an order in which those behind come first. The
///              refine set of a face is the directed visible set of the one view cell behind it:
///
///                  +-----+-----+-----+     quadrant "up and right": C is done first, then B.
///                  |  A -|> B -|> C  |     What A sees to the right through its face to B is
///                  +-----+-----+-----+     part of what B sees in that quadrant, or is in B.
///
/// Invariant: a refine set lacks nothing that is seen through the face. So all methods find the
/// same. Cost: brute O(view cells x objects); multipass tests at most K candidates for each
/// relation that it finds, where K is the number of view cells that depend on one (Laine 2005,
/// section 6.3).
#include "study/from_region/from_region_scene.h"

#include "base/bits.h"
#include "sightline/support.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

struct region_thread;

/// A method at work. Each method numbers its own units of work.
typedef struct region_work {
    const sl_from_region_scene *scene;
    const sl_from_region_options *options;
    const sli_from_region_solver_calls *solver;
    pthread_mutex_t lock;
    sli_from_region_account account; ///< under the lock
    uint64_t candidates, relations;  ///< under the lock
    sl_bits *all;                    ///< every object
    sl_bits *seen;                   ///< the result: by view cell
    void *own;                       ///< the method's
    sl_status (*unit)(sl_context *context, struct region_work *work, struct region_thread *thread,
                      size_t unit);
} region_work;

/// What each thread has for itself.
typedef struct region_thread {
    void *solver;
    sli_from_region_account account;
    uint64_t candidates, relations;
    sl_bits *set; ///< scratch: a row
} region_thread;

/// Whether sightlines of a quadrant leave by a face.
static bool faces_quadrant(const sl_from_region_scene *scene, uint32_t face, int quadrant) {
    return scene->passes[quadrant].leaves.faces[scene->faces.items[face].directed] != SLI_NO_FACE;
}

static void add_row(sl_bits *to, const sl_bits *from, size_t words) {
    for (size_t i = 0; i < words; i++) to[i] |= from[i];
}

// --- solving by several threads

/// Adds what is seen through a face: in all quadrants that it faces, or in one (0 .. 3; -1 for
/// all).
static sl_status solve_face(sl_context *context, const region_work *work, region_thread *thread,
                            uint32_t face, int quadrant, const sl_bits *refine, sl_bits *seen) {
    for (int q = 0; q < SLI_QUADRANTS; q++) {
        if ((quadrant >= 0 && q != quadrant) || !faces_quadrant(work->scene, face, q)) continue;
        const sli_from_region_query query = {&work->scene->faces.items[face], q, refine};
        SL_TRY(work->solver->run(context, thread->solver, &query, seen, &thread->account));
    }
    return SL_OK;
}

static void end_region_worker(sl_context *context, void *job, void *state) {
    region_work *work = job;
    region_thread *me = state;
    pthread_mutex_lock(&work->lock);
    work->account.images += me->account.images;
    work->account.rays += me->account.rays;
    work->account.refined += me->account.refined;
    work->candidates += me->candidates;
    work->relations += me->relations;
    pthread_mutex_unlock(&work->lock);
    work->solver->destroy(context, me->solver);
    sl_free(context, me->set);
    sl_free(context, me);
}

static sl_status begin_region_worker(sl_context *context, void *job, void **state) {
    region_work *work = job;
    region_thread *me = sl_alloc_array(context, 1, sizeof *me);
    if (!me) return SL_NO_MEMORY;
    me->set = sl_alloc_array(context, work->scene->words, sizeof *me->set);
    sl_status status = me->set ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK)
        status = work->solver->create(context, work->scene, work->options, &me->solver);
    if (status == SL_OK)
        *state = me;
    else
        end_region_worker(context, job, me);
    return status;
}

static sl_status run_unit(sl_context *context, void *job, void *state, size_t unit) {
    region_work *work = job;
    return work->unit(context, work, state, unit);
}

/// Runs the units of work by all threads; `after` as that of sl_work.
static sl_status run_units(sl_context *context, region_work *work, size_t count,
                           const size_t *after) {
    const sl_work threads = {
        .job = work,
        .begin = begin_region_worker,
        .unit = run_unit,
        .end = end_region_worker,
        .leave_thread = work->options->solver->stabs ? work->options->stab->leave_thread : NULL,
        .stage = "from_region",
        .units = "steps",
        .after = after};
    return sl_work_run(context, &threads, count, work->options->threads);
}

// --- brute force

/// A view cell on its own: all objects through all of its faces.
static sl_status brute_unit(sl_context *context, region_work *work, region_thread *thread,
                            size_t unit) {
    const sl_from_region_scene *scene = work->scene;
    sl_bits *row = work->seen + unit * scene->words;
    for (uint32_t face = scene->first_face[unit]; face < scene->first_face[unit + 1]; face++)
        SL_TRY(solve_face(context, work, thread, face, -1, work->all, row));
    thread->candidates += SLI_QUADRANTS * (uint64_t)sli_from_region_objects(scene);
    add_row(row, sli_from_region_inside(scene, (uint32_t)unit), scene->words);
    return SL_OK;
}

static sl_status brute(sl_context *context, region_work *work) {
    work->unit = brute_unit;
    return run_units(context, work, work->scene->counts.view_cells, NULL);
}

// --- hierarchy: view cells halved again and again. A half sees what lies in it and what its own
// outer faces see; those faces lie between larger halves, so they are solved before.

/// View cells order[first .. end); the root is node 0, a parent before its children.
typedef struct node {
    uint32_t first, end, depth;
    uint32_t parent;
} node;

/// A unit of work: a node's visible set to be made, or a face to be solved.
typedef struct task {
    uint32_t node; ///< whose set is made, or is the refine set
    uint32_t face; ///< UINT32_MAX: make the set
    uint32_t depth;
} task;

typedef struct hierarchy {
    sli_placed *cells;
    SL_ARRAY(node) nodes;
    uint32_t *leaf; ///< by view cell: its node
    task *tasks;
    size_t *after;
    sl_bits *cache; ///< by face: what it sees
    sl_bits *sets;  ///< by node
} hierarchy;

static sl_status place_cells(sl_context *context, const sl_from_region_scene *scene,
                             sli_placed *cells) {
    const uint32_t count = scene->counts.view_cells;
    sl_box *boxes = sl_alloc_array(context, count, sizeof *boxes);
    if (!boxes) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < count; i++)
        boxes[i] = (sl_box){{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (uint32_t leaf = 0; leaf < scene->space.cell_count; leaf++) {
        if (scene->view_cell[leaf] == SL_NO_VIEW_CELL) continue;
        sl_box *box = &boxes[scene->view_cell[leaf]];
        const sl_box own = sli_leaf_box(&scene->space, leaf);
        box->min.x = fmin(box->min.x, own.min.x);
        box->min.y = fmin(box->min.y, own.min.y);
        box->max.x = fmax(box->max.x, own.max.x);
        box->max.y = fmax(box->max.y, own.max.y);
    }
    for (uint32_t i = 0; i < count; i++)
        cells[i] = (sli_placed){{boxes[i].min.x + (boxes[i].max.x - boxes[i].min.x) / 2,
                                 boxes[i].min.y + (boxes[i].max.y - boxes[i].min.y) / 2},
                                i};
    sl_free(context, boxes);
    return SL_OK;
}

/// Sorts a node's view cells along the longer side of the box about their middles and cuts there at
/// its middle.
static uint32_t cut(sli_placed *cells, uint32_t first, uint32_t end) {
    sl_box box;
    const bool wide = sli_placed_sort(cells + first, end - first, &box);
    const double middle =
        wide ? box.min.x + (box.max.x - box.min.x) / 2 : box.min.y + (box.max.y - box.min.y) / 2;
    uint32_t at = first;
    while (at < end && (wide ? cells[at].at.x : cells[at].at.y) < middle) at++;
    return at > first && at < end ? at : first + (end - first) / 2;
}

static sl_status divide(sl_context *context, hierarchy *h, uint32_t count) {
    SL_TRY(SL_ARRAY_ROOM(context, &h->nodes, 1));
    h->nodes.items[h->nodes.count++] = (node){.end = count};
    for (uint32_t i = 0; i < h->nodes.count; i++) {
        const node n = h->nodes.items[i];
        if (n.end - n.first <= 1) {
            if (n.end > n.first) h->leaf[h->cells[n.first].number] = i;
            continue;
        }
        const uint32_t at = cut(h->cells, n.first, n.end);
        SL_TRY(SL_ARRAY_ROOM(context, &h->nodes, 2));
        h->nodes.items[h->nodes.count++] = (node){n.first, at, n.depth + 1, i};
        h->nodes.items[h->nodes.count++] = (node){at, n.end, n.depth + 1, i};
    }
    return SL_OK;
}

/// The node whose halves a face lies between; the root for those of the compound's boundary.
static uint32_t node_of(const hierarchy *h, const sli_face *face) {
    if (face->to == SL_NO_VIEW_CELL) return 0;
    uint32_t a = h->leaf[face->from], b = h->leaf[face->to];
    while (a != b) {
        // Parents come before their children.
        if (a > b)
            a = h->nodes.items[a].parent;
        else
            b = h->nodes.items[b].parent;
    }
    return a;
}

// The units of work, from the root down.

/// Sets of a depth are made when all faces of less depth are solved. Faces of a depth are solved
/// when its sets are made.
static size_t rank_of(const task *t) {
    return 2 * (size_t)t->depth + (t->face != UINT32_MAX);
}

static sl_status list_tasks(sl_context *context, const sl_from_region_scene *scene, hierarchy *h) {
    const size_t nodes = h->nodes.count, count = nodes + scene->counts.faces;
    uint32_t depth = h->nodes.items[nodes - 1].depth;
    const size_t ranks = 2 * (size_t)depth + 2;
    size_t *starts = sl_alloc_array(context, ranks + 1, sizeof *starts);
    task *found = sl_alloc_array(context, count, sizeof *found);
    if (!starts || !found) {
        sl_free(context, starts);
        sl_free(context, found);
        return SL_NO_MEMORY;
    }
    for (uint32_t i = 0; i < nodes; i++) found[i] = (task){i, UINT32_MAX, h->nodes.items[i].depth};
    for (uint32_t i = 0; i < scene->counts.faces; i++) {
        const uint32_t at = node_of(h, &scene->faces.items[i]);
        found[nodes + i] = (task){at, i, h->nodes.items[at].depth};
    }
    for (size_t i = 0; i < count; i++) starts[rank_of(&found[i]) + 1]++;
    for (size_t rank = 0; rank < ranks; rank++) {
        starts[rank + 1] += starts[rank];
        for (size_t i = starts[rank]; i < starts[rank + 1]; i++) h->after[i] = starts[rank];
    }
    for (size_t i = 0; i < count; i++) h->tasks[starts[rank_of(&found[i])]++] = found[i];
    sl_free(context, starts);
    sl_free(context, found);
    return SL_OK;
}

/// Makes the set of a node: what lies in it and what its outer faces see; all objects for the root.
static void make_set(const region_work *work, uint32_t number) {
    const sl_from_region_scene *scene = work->scene;
    const hierarchy *h = work->own;
    const node *n = &h->nodes.items[number];
    sl_bits *set = h->sets + number * scene->words;
    if (number == 0) memcpy(set, work->all, scene->words * sizeof *set);
    for (uint32_t i = n->first; i < n->end && number; i++) {
        const uint32_t cell = h->cells[i].number;
        add_row(set, sli_from_region_inside(scene, cell), scene->words);
        for (uint32_t f = scene->first_face[cell]; f < scene->first_face[cell + 1]; f++) {
            const uint32_t to = scene->faces.items[f].to;
            bool outer = to == SL_NO_VIEW_CELL;
            if (!outer) {
                uint32_t above = h->leaf[to];
                while (above > number) above = h->nodes.items[above].parent;
                outer = above != number;
            }
            if (outer) add_row(set, h->cache + f * scene->words, scene->words);
        }
    }
    if (n->end - n->first != 1) return;
    sl_bits *row = work->seen + h->cells[n->first].number * scene->words;
    // A compound of one view cell has its root for a leaf.
    memcpy(row, number ? set : sli_from_region_inside(scene, h->cells[n->first].number),
           scene->words * sizeof *row);
}

static sl_status task_unit(sl_context *context, region_work *work, region_thread *thread,
                           size_t unit) {
    const hierarchy *h = work->own;
    const task t = h->tasks[unit];
    const size_t words = work->scene->words;
    const sl_bits *set = h->sets + t.node * words;
    if (t.face == UINT32_MAX) {
        make_set(work, t.node);
        return SL_OK;
    }
    thread->candidates += sli_bits_count(set, words);
    sl_bits *seen = h->cache + t.face * words;
    SL_TRY(solve_face(context, work, thread, t.face, -1, set, seen));
    const node *n = &h->nodes.items[t.node];
    if (n->end - n->first > 1) return SL_OK;
    // The boundary of a compound of one view cell: no other unit adds this.
    pthread_mutex_lock(&work->lock);
    add_row(work->seen + h->cells[n->first].number * words, seen, words);
    pthread_mutex_unlock(&work->lock);
    return SL_OK;
}

static sl_status run(sl_context *context, region_work *work, hierarchy *h) {
    const sl_from_region_scene *scene = work->scene;
    const size_t cells = scene->counts.view_cells, faces = scene->counts.faces;
    if (!cells) return SL_OK;
    h->cells = sl_alloc_array(context, cells, sizeof *h->cells);
    h->leaf = sl_alloc_array(context, cells, sizeof *h->leaf);
    h->tasks = sl_alloc_array(context, 2 * cells + faces, sizeof *h->tasks);
    h->after = sl_alloc_array(context, 2 * cells + faces, sizeof *h->after);
    h->cache = sl_alloc_array(context, faces, scene->words * sizeof *h->cache);
    h->sets = sl_alloc_array(context, 2 * cells, scene->words * sizeof *h->sets);
    if (!h->cells || !h->leaf || !h->tasks || !h->after || !h->cache || !h->sets)
        return SL_NO_MEMORY;
    SL_TRY(place_cells(context, scene, h->cells));
    SL_TRY(divide(context, h, (uint32_t)cells));
    SL_TRY(list_tasks(context, scene, h));
    return run_units(context, work, h->nodes.count + faces, h->after);
}

static sl_status hierarchy_method(sl_context *context, region_work *work) {
    hierarchy h = {0};
    work->own = &h;
    work->unit = task_unit;
    const sl_status status = run(context, work, &h);
    sl_free(context, h.cells);
    sl_free(context, h.nodes.items);
    sl_free(context, h.leaf);
    sl_free(context, h.tasks);
    sl_free(context, h.after);
    sl_free(context, h.cache);
    sl_free(context, h.sets);
    return status;
}

// --- multipass (Laine 2005, algorithm 1). Nothing is known of what lies behind the boundary of the
// compound: there the refine set is all objects.

/// A view cell in a quadrant.
typedef struct visit {
    uint32_t view_cell;
    int quadrant;
} visit;

typedef struct passes {
    visit *visits; ///< by level
    size_t *after;
    sl_bits *directed; ///< by quadrant, then view cell
} passes;

static sl_bits *directed_of(const region_work *work, int quadrant, uint32_t view_cell) {
    const passes *p = work->own;
    return p->directed +
           ((size_t)quadrant * work->scene->counts.view_cells + view_cell) * work->scene->words;
}

static sl_status visit_unit(sl_context *context, region_work *work, region_thread *thread,
                            size_t unit) {
    const sl_from_region_scene *scene = work->scene;
    const passes *p = work->own;
    const visit v = p->visits[unit];
    sl_bits *row = directed_of(work, v.quadrant, v.view_cell);
    memset(thread->set, 0, scene->words * sizeof *thread->set);
    for (uint32_t f = scene->first_face[v.view_cell]; f < scene->first_face[v.view_cell + 1]; f++) {
        const uint32_t behind = scene->faces.items[f].to;
        if (!faces_quadrant(scene, f, v.quadrant)) continue;
        const sl_bits *refine =
            behind == SL_NO_VIEW_CELL ? work->all : directed_of(work, v.quadrant, behind);
        add_row(thread->set, refine, scene->words);
        SL_TRY(solve_face(context, work, thread, f, v.quadrant, refine, row));
    }
    add_row(row, sli_from_region_inside(scene, v.view_cell), scene->words);
    thread->candidates += sli_bits_count(thread->set, scene->words);
    thread->relations += sli_bits_count(row, scene->words);
    pthread_mutex_lock(&work->lock);
    add_row(work->seen + v.view_cell * scene->words, row, scene->words);
    pthread_mutex_unlock(&work->lock);
    return SL_OK;
}

/// Lists all view cells of all quadrants by level. Each is a component of its own: no cycles.
static sl_status list_visits(sl_context *context, const sl_from_region_scene *scene, passes *p) {
    uint32_t levels = 0;
    for (int q = 0; q < SLI_QUADRANTS; q++)
        if (scene->passes[q].view_cells.level_count > levels)
            levels = scene->passes[q].view_cells.level_count;
    size_t *starts = sl_alloc_array(context, (size_t)levels + 1, sizeof *starts);
    if (!starts) return SL_NO_MEMORY;
    for (int q = 0; q < SLI_QUADRANTS; q++) {
        const sli_order *order = &scene->passes[q].view_cells;
        for (uint32_t k = 0; k < order->component_count; k++) starts[order->level[k] + 1]++;
    }
    for (uint32_t level = 0; level < levels; level++) {
        starts[level + 1] += starts[level];
        for (size_t i = starts[level]; i < starts[level + 1]; i++) p->after[i] = starts[level];
    }
    for (int q = 0; q < SLI_QUADRANTS; q++) {
        const sli_order *order = &scene->passes[q].view_cells;
        for (uint32_t k = 0; k < order->component_count; k++)
            p->visits[starts[order->level[k]]++] = (visit){order->nodes[order->starts[k]], q};
    }
    sl_free(context, starts);
    return SL_OK;
}

static sl_status multipass_method(sl_context *context, region_work *work) {
    const sl_from_region_scene *scene = work->scene;
    const size_t count = (size_t)SLI_QUADRANTS * scene->counts.view_cells;
    passes p = {.visits = sl_alloc_array(context, count, sizeof *p.visits),
                .after = sl_alloc_array(context, count, sizeof *p.after),
                .directed = sl_alloc_array(context, count, scene->words * sizeof *p.directed)};
    sl_status status = p.visits && p.after && p.directed ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) status = list_visits(context, scene, &p);
    work->own = &p;
    work->unit = visit_unit;
    if (status == SL_OK) status = run_units(context, work, count, p.after);
    sl_free(context, p.visits);
    sl_free(context, p.after);
    sl_free(context, p.directed);
    return status;
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

uint64_t sl_from_region_pairs(const sl_from_region_result *result) {
    return sli_bits_count(result->seen, (size_t)result->view_cells * result->words);
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

/// Removes occluders that are no objects from the rows, and fills the result.
static void fill(const region_work *work, sl_from_region_result *out) {
    const sl_from_region_scene *scene = work->scene;
    const uint32_t objects = scene->counts.objects;
    for (uint32_t i = 0; i < scene->counts.view_cells && scene->occluders; i++) {
        sl_bits *row = work->seen + i * scene->words;
        for (uint32_t k = objects; k < sli_from_region_objects(scene); k++)
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

static sl_status see(sl_context *context, const sl_from_region_scene *scene,
                     const sl_from_region_options *options,
                     sl_status (*method)(sl_context *, region_work *), sl_from_region_result *out) {
    SL_TRY(check_options(context, options));
    region_work work = {.scene = scene,
                        .options = options,
                        .solver = options->solver->stabs ? sli_from_region_stabs()
                                                         : sli_from_region_sampling()};
    work.all = sl_alloc_array(context, scene->words, sizeof *work.all);
    work.seen = sl_alloc_array(context, scene->counts.view_cells, scene->words * sizeof(sl_bits));
    pthread_mutex_init(&work.lock, NULL);
    sl_status status = work.all && work.seen ? SL_OK : SL_NO_MEMORY;
    for (uint32_t i = 0; i < sli_from_region_objects(scene) && status == SL_OK; i++)
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

static sl_status see_brute(sl_context *context, const sl_from_region_scene *scene,
                           const sl_from_region_options *options, sl_from_region_result *out) {
    return see(context, scene, options, brute, out);
}

static sl_status see_hierarchy(sl_context *context, const sl_from_region_scene *scene,
                               const sl_from_region_options *options, sl_from_region_result *out) {
    return see(context, scene, options, hierarchy_method, out);
}

static sl_status see_multipass(sl_context *context, const sl_from_region_scene *scene,
                               const sl_from_region_options *options, sl_from_region_result *out) {
    return see(context, scene, options, multipass_method, out);
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
