/// The measures of many eyes, found by several threads, and told as CSV.
#ifndef ISOVIST_RUN_H
#define ISOVIST_RUN_H

#include "isovist_eyes.h"
#include "names.h"
#include "sightline/region.h"

typedef struct sl_isovist {
    sl_region_measures measures;
    size_t corners; ///< of walls that are seen
} sl_isovist;

/// The measures by name.
sl_name_table sl_isovist_measures(void);
double sl_isovist_value(const sl_isovist *isovist, size_t measure);

/// The view of an eye.
sl_view sl_eye_view(const sl_space *space, const sl_eye *eye);

/// Fills out[0 .. eyes->list.count). Reports stage "isovist".
sl_status sl_isovist_run(sl_context *context, const sl_outline *outline, const sl_eyes *eyes,
                         double range, unsigned threads, sl_isovist *out);

/// Writes the table to a file, "-" for stdout.
sl_status sl_isovist_write(sl_context *context, const sl_eyes *eyes, const sl_isovist *isovists,
                           const char *path);

#endif
