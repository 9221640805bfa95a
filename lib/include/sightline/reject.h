/// Doom's REJECT: the table of sectors that never see each other, computed for the maps of a WAD.
#ifndef SIGHTLINE_REJECT_H
#define SIGHTLINE_REJECT_H

#include "sightline/stab.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Start from sl_reject_options_default().
typedef struct sl_reject_options {
    /// Names of maps, in small letters or capitals; none: all maps of the WAD.
    const char *const *maps;
    size_t map_count;
    sl_sight sight;     ///< open: sightlines that only touch ends of walls do not count
    unsigned threads;   ///< 0: one a core; the result does not depend on it
    uint64_t row_bytes; ///< limit on memory for visible sets, of all maps at work together
} sl_reject_options;

/// The usual options: all maps, open sight.
SL_API sl_reject_options sl_reject_options_default(void);

/// What the REJECT of a map holds.
typedef struct sl_reject_account {
    char map[9];
    uint32_t sectors, cells;
    uint32_t unknown; ///< sectors without a cell that was looked from: nothing is hidden from them
    uint64_t hidden;  ///< unordered pairs of sectors
} sl_reject_account;

/// Of each map, in the order of the WAD or as they were asked for. Zeroed, it is empty.
typedef struct sl_reject_report {
    sl_reject_account *maps;
    size_t count;
} sl_reject_report;

SL_API void sl_reject_report_destroy(sl_context *context,
                                     sl_reject_report *report); ///< and zeroes it

/// Writes a copy of a WAD in which maps have a new REJECT; "-" for stdout. Each map is cut into
/// cells that lie in one sector each, and the sweep computes exactly which cells see each other;
/// doors are seen through. Hidden are pairs of sectors that no sightline past all walls joins. All
/// other lumps keep their bytes. The WAD is read once and written once, when all maps are done;
/// what fails, or is cancelled, leaves an older file as it was. SL_BAD_INPUT names the map;
/// SL_BAD_ARGUMENT where a map is asked for twice or there is none. Reports stage "reject", unit
/// "maps"; of a single map the stages of its bake. `report` must be empty; on failure it stays so.
SL_API sl_status sl_reject_wad(sl_context *context, const char *path,
                               const sl_reject_options *options, const char *output,
                               sl_reject_report *report);

#ifdef __cplusplus
}
#endif

#endif
