/// What the pictures of two plans do not share: a drag draws that part again, and no other.
#ifndef VIEWER_CHANGES_H
#define VIEWER_CHANGES_H

#include "sightline/draw.h"
#include "sightline/support.h"

/// Something that is drawn, and where.
typedef struct plan_item {
    uint64_t hash; ///< of all that its look depends on
    sl_box box;    ///< in the map
} plan_item;

/// Sorted. Zeroed to start.
typedef SL_ARRAY(plan_item) plan_items;

/// Lists cells and portals, or with `over` walls and what else the map holds. Replaces the list.
sl_status plan_items_list(sl_context *context, const sl_baked *baked, const sl_scene *scene,
                          bool over, plan_items *items);

enum { CHANGES_MOST = 6 };

/// Few boxes that cover all items that only one of two lists has. Returns how many.
int plan_items_compare(const plan_items *a, const plan_items *b, sl_box boxes[CHANGES_MOST]);

/// Gives a scene the line widths of an earlier one, which follow the size of cells: parts of both
/// are in one picture. *size is 0 for the first scene, and set by it. All lines are `stronger`
/// times as wide as usual.
void plan_keep_pens(sl_scene *scene, double *size, double stronger);

#endif
