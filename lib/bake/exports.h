/// The exports that the table lists.
#ifndef SL_EXPORTS_H
#define SL_EXPORTS_H

#include "sightline/bake.h"

sl_status sl_export_json(sl_context *context, const sl_baked *baked,
                         const sl_export_options *options, const char *path);

/// A copy of options->wad in which the REJECT of options->map says which sectors never see each
/// other: those of which no cells do. Nothing is hidden that a sightline joins: a cell counts for
/// each sector that it reaches into. SL_BAD_INPUT where the map's walls are not those of the baked
/// file; SL_BAD_ARGUMENT where that was baked by a method that may miss something, or with doors.
sl_status sl_export_reject(sl_context *context, const sl_baked *baked,
                           const sl_export_options *options, const char *path);

/// "from,to", a line for each ordered pair seen.
sl_status sl_export_csv(sl_context *context, const sl_baked *baked,
                        const sl_export_options *options, const char *path);
/// A PNG of one bit a pixel: row a, column b is black where cell a sees cell b. SL_UNSUPPORTED for
/// more cells than such a picture can have.
sl_status sl_export_png(sl_context *context, const sl_baked *baked,
                        const sl_export_options *options, const char *path);
/// A C header with the matrix, a bit a pair.
sl_status sl_export_c(sl_context *context, const sl_baked *baked, const sl_export_options *options,
                      const char *path);

#endif
