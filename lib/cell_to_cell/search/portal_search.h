/// The one depth-first search over portal sequences (Teller & Séquin 1991). Every method that
/// follows sightlines from cell to cell uses it, and says in a visitor what is particular to it.
///
///     cell 0 --portal--> cell 1 --portal--> cell 2 ...      the way: one step for each cell
///
/// The search keeps the way as a stack of steps. It tries every directed portal of the last cell,
/// then every mirror on the cell's sides, then leaves the cell. The visitor decides whether to go
/// through: it may hold bounds, doors, glass, the range and a solver against the crossing.
///
/// Invariant: where the visitor tests by a solver, the solver holds the portals of the way, one for
/// each step but the first; one more where the search starts behind a portal.
///
/// Cost: one visit for each crossing of each step. The visitor is a constant, so that the compiler
/// makes a copy of the search for each method: no call goes through a pointer.
#ifndef SL_PORTAL_SEARCH_H
#define SL_PORTAL_SEARCH_H

#include "effects/mirrors.h"
#include "sightline/space.h"
#include "sightline/stab.h"
#include "sightline/support.h"

/// What each step begins with. A method's own step has it as its first member.
typedef struct sli_portal_step {
    uint32_t cell;
    uint32_t next; ///< crossing to try next: the cell's directed portals, then its mirrors
} sli_portal_step;

/// A search under way; one thread's own. Zeroed but for the space, it is ready to start.
typedef struct sli_portal_search {
    const sl_space *space;
    const sli_mirror_sides *mirrors; ///< NULL: none
    const sl_solver *solver;         ///< NULL: the visitor tests in another way
    void *solver_state;
    size_t held; ///< portals that the solver holds
    bool stop;   ///< set by a visitor: the search ends at once
    void *steps; ///< the way, of the visitor's own steps
    size_t count, capacity;
} sli_portal_search;

/// A visitor enters up to so many steps by one crossing.
enum { SLI_MOST_ENTERED = 2 };

/// What a method decides. All functions get the method's own `job`.
typedef struct sli_portal_visitor {
    size_t step_size; ///< of the method's own step
    /// Tries a directed portal of the last step, `from`. To enter the cell behind it, the visitor
    /// fills to[0] (or to[0] and to[1]) and adds to the search's count.
    sl_status (*cross)(sl_context *context, void *job, const void *from, void *to, uint32_t number);
    /// Likewise a mirror, by its number among the mirror sides; NULL for methods without mirrors.
    sl_status (*reflect)(sl_context *context, void *job, const void *from, void *to,
                         uint32_t number);
    /// The last step, `left`, has been taken off; NULL for nothing to do.
    sl_status (*leave)(sl_context *context, void *job, const void *left);
} sli_portal_visitor;

/// Stands before a visitor's function that the compiler is to put into its copy of the search, and
/// before others that it is to copy.
#define SLI_VISIT static inline __attribute__((always_inline))

static inline void *sli_portal_search_step(const sli_portal_search *search, size_t step_size,
                                           size_t i) {
    return (char *)search->steps + i * step_size;
}

/// Makes room for the steps of one crossing.
static inline sl_status sli_portal_search_room(sl_context *context, sli_portal_search *search,
                                               size_t step_size) {
    return search->count + SLI_MOST_ENTERED <= search->capacity
               ? SL_OK
               : sl_reserve(context, &search->steps, &search->capacity,
                            search->count + SLI_MOST_ENTERED, step_size);
}

/// Starts a way: room for its first step, at the start of `steps`, which the caller fills and
/// counts.
static inline sl_status sli_portal_search_start(sl_context *context, sli_portal_search *search,
                                                size_t step_size) {
    search->count = 0;
    search->stop = false;
    return sli_portal_search_room(context, search, step_size);
}

/// Adds a portal to the solver's sequence.
static inline sl_status sli_portal_search_push(sl_context *context, sli_portal_search *search,
                                               sl_point left, sl_point right,
                                               sl_stab_verdict *verdict) {
    SL_TRY(search->solver->push(context, search->solver_state, left, right, verdict));
    search->held++;
    return SL_OK;
}

/// Takes the last portal off again.
static inline void sli_portal_search_pop(sli_portal_search *search) {
    search->held--;
    search->solver->pop(search->solver_state);
}

/// Follows all sequences that the visitor lets it, from the steps that are there. Ends with no
/// steps, and with nothing held by the solver; after a stop the steps are left as they are.
static inline sl_status sli_portal_search_run(sl_context *context, sli_portal_search *search,
                                              const sli_portal_visitor *visitor, void *job) {
    const size_t size = visitor->step_size;
    while (search->count && !search->stop) {
        SL_TRY(sli_portal_search_room(context, search, size));
        const size_t count = search->count;
        sli_portal_step *last = sli_portal_search_step(search, size, count - 1);
        void *to = sli_portal_search_step(search, size, count);
        const sl_cell *cell = &search->space->cells[last->cell];
        while (last->next < cell->directed_count && search->count == count && !search->stop)
            SL_TRY(visitor->cross(context, job, last, to, cell->first_directed + last->next++));
        if (search->count != count || search->stop) continue;
        if (visitor->reflect && search->mirrors) {
            const uint32_t side =
                search->mirrors->first[last->cell] + last->next - cell->directed_count;
            if (side < search->mirrors->first[last->cell + 1]) {
                last->next++;
                SL_TRY(visitor->reflect(context, job, last, to, side));
                continue;
            }
        }
        search->count--;
        if (search->held) sli_portal_search_pop(search);
        if (visitor->leave) SL_TRY(visitor->leave(context, job, last));
    }
    while (search->held) sli_portal_search_pop(search);
    return SL_OK;
}

/// Frees the way and the solver.
static inline void sli_portal_search_end(sl_context *context, sli_portal_search *search) {
    if (search->solver) search->solver->destroy(context, search->solver_state);
    sl_free(context, search->steps);
    *search = (sli_portal_search){0};
}

#endif
