/// Where the labels of a chart's marks stand.
#ifndef SL_DRAW_CHART_LABELS_H
#define SL_DRAW_CHART_LABELS_H

#include "sightline/geometry.h"

#include <stdbool.h>
#include <stddef.h>

/// A label: what it is of and how large, and where it came to stand. In page coordinates.
typedef struct sl_label {
    sl_point anchor;
    double width, height;
    bool placed;   ///< false: there was no room
    sl_box box;    ///< where it stands
    sl_point knee; ///< where the line from its anchor meets it
    /// The search's own. Of the label in array place n: the one whose turn is the n-th, and that of
    /// the best search so far.
    size_t turn, best_turn;
} sl_label;

/// What labels and their lines keep off.
typedef struct sl_obstacle {
    sl_box box;
    size_t owner;     ///< the label whose line may cross it; SIZE_MAX for none
    bool lines_cross; ///< any line may; so may one that starts within it
} sl_obstacle;

/// Room for labels: within `frame`, `gap` away from obstacles and other labels, and `clearance`
/// from their own anchors.
typedef struct sl_label_room {
    sl_box frame;
    const sl_obstacle *obstacles;
    size_t obstacle_count;
    double gap, clearance;
} sl_label_room;

/// Places labels, each as near to its anchor as it can stand with its line crossing no obstacle,
/// label or other line. Returns whether all found room.
bool sl_labels_place(sl_label *labels, size_t count, const sl_label_room *room);

#endif
