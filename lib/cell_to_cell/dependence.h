/// What depends on what, and an order in which all that something depends on comes first (Laine
/// 2005, section 4).
#ifndef SL_DEPENDENCE_H
#define SL_DEPENDENCE_H

#include "sightline/context.h"

/// Node n depends on to[first[n]] .. to[first[n + 1] - 1].
typedef struct sl_dependence {
    uint32_t count;
    const uint32_t *first; ///< count + 1
    const uint32_t *to;
} sl_dependence;

/// The nodes in components: those that depend on each other round a cycle are in one, all others
/// alone. Component k is nodes[starts[k]] .. nodes[starts[k + 1] - 1]; it depends on components
/// before it only, and its level is one more than the highest of theirs, from 0.
typedef struct sl_order {
    uint32_t count, component_count, level_count;
    uint32_t *nodes;
    uint32_t *starts;    ///< component_count + 1
    uint32_t *component; ///< by node
    uint32_t *level;     ///< by component
} sl_order;

/// Tarjan 1972, Depth-First Search and Linear Graph Algorithms. Time and memory linear.
sl_status sl_order_create(sl_context *context, const sl_dependence *graph, sl_order *out);
void sl_order_destroy(sl_context *context, sl_order *order);

#endif
