/// What the parts of search_sequences share: asking all solvers, and shrinking what is found.
#ifndef SL_SEARCH_H
#define SL_SEARCH_H

#include "oracle/margin.h"
#include "oracle/random_sequence.h"
#include "solver_table.h"

/// One solver's verdicts, portal by portal, up to the first that hides; `status` tells of what
/// ended them early.
typedef struct search_answer {
    sl_status status;
    size_t count;
    bool changed; ///< taken back in part and asked again, it said something else
    sl_stab_verdict verdicts[RANDOM_PORTALS];
} search_answer;

/// All that is known of a sequence. `portals` are those that were asked: a portal that no direction
/// crosses together with those before is left out, and the first that hides the rest is the last.
typedef struct search_trial {
    random_portals portals;
    sl_stab_verdict truth[RANDOM_PORTALS];
    oracle_margin margin; ///< of all of them
    double size;          ///< of the bounds: the larger side
    search_answer answers[SOLVERS_MOST];
} search_trial;

/// A disagreement: what a solver said of the whole of a sequence, and what is so.
typedef struct search_fault {
    size_t solver;
    sl_stab_verdict said, is;
    double miss; ///< at least so far from grazing, as a share of the size
} search_fault;

typedef struct search {
    sl_context *context;
    const sl_solver *solvers[SOLVERS_MOST];
    size_t solver_count;
} search;

/// Asks the references and every solver. Where `back` is not 0, the sequence is taken back to
/// `back` - 1 portals and asked again from there. False where fewer than two portals are left, or
/// the two references disagree (which `trial` then tells).
bool search_ask(const search *s, const random_portals *portals, size_t back, search_trial *trial);

/// Whether the references contradict each other.
bool search_references_differ(const search_trial *trial);

double search_miss(const search_trial *trial);

/// Makes a sequence with the fault as short and plain as it gets; it keeps the fault.
void search_shrink(const search *s, const search_fault *fault, random_portals *portals);

/// For the search to prove that it finds: stabbing in plain doubles, which calls itself exact.
const sl_solver *search_doubles(void);

#endif
