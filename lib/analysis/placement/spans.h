/// Which parts of a window other points see. All is in terms of spots: places where given lines
/// meet the line of the window. Their order along it is exact.
#ifndef SLI_PLACE_SPANS_H
#define SLI_PLACE_SPANS_H

#include "analysis/placement/looks.h"
#include "sightline/support.h"

/// Where a line meets the line of a track.
typedef struct sli_spot {
    sl_segment line;
    double at, error; ///< its share of the way from the eye (0) to the apex (1), to that error
} sli_spot;

/// A window as the way from its apex to its far end.
typedef struct sli_track {
    sl_segment line; ///< from the eye to the apex
    sl_point far;    ///< rounded
    sli_spot start, end;
    int seen; ///< the side of the line that the eye sees
} sli_track;

/// Part of a track, from < to, or one spot.
typedef struct sli_span {
    sli_spot from, to;
} sli_span;

typedef SL_ARRAY(sli_span) sli_spans;

sli_track sli_track_of(const sli_look *look, uint32_t window);

/// The spot of a point on the line of a track, or of a line that is not parallel to it.
sli_spot sli_spot_of_point(const sl_segment *line, sl_point point);
sli_spot sli_spot_of_line(const sl_segment *line, sl_segment other);
/// The sign of a - b. Exact.
int sli_spot_order(const sl_segment *line, const sli_spot *a, const sli_spot *b);
/// Its share, rounded.
double sli_spot_share(const sli_spot *spot);
/// The point at a share of the way from the eye to the apex, rounded.
sl_point sli_track_at(const sli_track *track, double share);

/// The point beside the track there, at a depth on the seen side (1) or the unseen one (-1),
/// rounded.
sl_point sli_track_beside(const sli_track *track, double share, int side, double depth);

/// The box around a track, wide enough for all that was rounded on a map without coordinates beyond
/// `bounds`: only regions whose bounds meet it have parts of the track.
sl_box sli_track_box(const sli_track *track, const sl_box *bounds);

/// The parts of a track in the region of a look, ascending: they do not touch. `beyond`: those
/// where, but for single points, what is just beyond the window (at its unseen side) is in the
/// region, too. Else those with any point in the closed region, single spots among them.
sl_status sli_track_spans(sl_context *context, const sli_track *track, const sli_look *look,
                          bool beyond, sli_spans *out);

#endif
