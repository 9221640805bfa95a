/// Which sets of witnesses one place can see.
#ifndef SLI_PLACE_COLUMNS_H
#define SLI_PLACE_COLUMNS_H

#include "analysis/placement/nearby.h"
#include "analysis/placement/place_ground.h"
#include "analysis/placement/spans.h"

/// Part of a window of a look: between two shares of the way (sli_spot.at), rounded. Or the eye of
/// the look: `window` is SLI_NO_WINDOW.
typedef struct sli_window_part {
    uint32_t look, window;
    double from, to;
} sli_window_part;

#define SLI_NO_WINDOW UINT32_MAX

/// Zeroed, it is empty.
typedef struct sli_place_columns {
    SL_ARRAY(size_t) ends;            ///< by column: the number of entries up to its last one
    SL_ARRAY(uint32_t) entries;       ///< ascending
    SL_ARRAY(sli_window_part) places; ///< by column: its witnesses see this
} sli_place_columns;

void sli_place_columns_destroy(sl_context *context, sli_place_columns *columns); ///< and zeroes it

/// A region is entered or left along a window.
typedef struct sli_crossing_event {
    sli_spot spot;
    uint32_t look;
    bool leaves;
} sli_crossing_event;

typedef SL_ARRAY(sli_crossing_event) sli_crossing_events;

/// The events of all windows, look by look, kept from one call to the next. Zeroed, it is empty.
typedef struct sli_crossings {
    uint32_t known; ///< looks whose events are there
    SL_ARRAY(sli_crossing_events) windows;
    sli_nearby near; ///< bounds of looks
} sli_crossings;

void sli_crossings_destroy(sl_context *context, sli_crossings *crossings); ///< and zeroes it

/// Keeps the events of some of the known looks, which move up to fill the list; `kept` by look.
sl_status sli_crossings_keep(sl_context *context, sli_crossings *crossings,
                             const sli_look *const *looks, const bool *kept);

/// All largest sets of general looks (sli_look.general) that some viewpoint is in the regions of,
/// and perhaps others. Exact.
sl_status sli_place_columns_make(sl_context *context, const sli_ground *ground,
                                 const sli_look *const *looks, uint32_t count,
                                 sli_crossings *crossings, sli_place_columns *out);

#endif
