/// The baked file (.slv): a space and its visibility, for the tools and for games.
#ifndef SIGHTLINE_BAKE_H
#define SIGHTLINE_BAKE_H

#include "sightline/cell_to_cell.h"
#include "sightline/view_cells.h"

#ifdef __cplusplus
extern "C" {
#endif

/// All that a baked file holds. Zeroed, it is empty. `map` holds what the map had beside its walls
/// (starts, paths, objects, notes ...); the walls are the space's.
typedef struct sl_baked {
    sl_map map;
    sl_space space;
    sl_visibility visibility;
    /// By name: letters, digits and dashes, zeros behind; solver "" for none.
    char method[16], solver[16];
    sl_view_rows views; ///< over the cells; none where the map was baked without view cells
    /// The file keeps what view cells see and not what cells do: the visible sets are those of
    /// their view cells (sl_view_rows_expand), each of which has one row and no parent.
    bool by_views;
    /// Of a bake that is not finished: what it has found. The visible sets then count as seen what
    /// is not decided; a shard has none. Zeroed where the bake is finished.
    sl_partial partial;
} sl_baked;

SL_API void sl_baked_destroy(sl_context *context, sl_baked *baked); ///< and zeroes it

/// Whether reports and pictures count a cell: the bake looked from it, and it is inside, where the
/// map's starts say what inside is.
SL_API bool sl_baked_counts(const sl_baked *baked, uint32_t cell);

/// Whether it is one shard of a bake: it has partial results and no visible sets.
SL_API bool sl_baked_is_shard(const sl_baked *baked);

/// The longest text of sl_baked_say_partial, its 0 included.
#define SL_PARTIAL_TEXT 128

/// Says for reports that the visible sets are those of a bake that was stopped: "partial: 412 of
/// 990 corners looked at; what is not decided counts as seen". Empty where the bake is finished.
SL_API void sl_baked_say_partial(const sl_baked *baked, char text[SL_PARTIAL_TEXT]);

/// Whether two spaces are the same to the last bit, cell by cell.
SL_API bool sl_baked_same_space(const sl_space *a, const sl_space *b);

/// Shuts doors (by number, those of `shut` that are true): the space gets walls in their place, and
/// the visible sets keep what is seen past them. Exact where the bake was; time and memory about
/// those of the visible sets. Stab trees and sets of doors are let go. SL_UNSUPPORTED where there
/// are mirrors. On failure `baked` stays as it was.
SL_API sl_status sl_baked_shut(sl_context *context, sl_baked *baked, const bool *shut);

/// Makes walls of the one-way glass that is dark for an eye: the space then serves for what that
/// eye sees, and the visible sets of its own cell are right for it. Stab trees are let go.
/// SL_UNSUPPORTED where there are mirrors. On failure `baked` stays as it was.
SL_API sl_status sl_baked_darken(sl_context *context, sl_baked *baked, sl_point eye);

/// Writes beside the target and takes its place when all is written: SL_IO leaves the old file
/// intact. The bytes depend on the contents alone. SL_BAD_ARGUMENT where there is no visible set
/// for each cell, or a name that is none. Reports stage "write".
SL_API sl_status sl_baked_write(sl_context *context, const sl_baked *baked, const char *path);

/// Reads and checks everything: the checksum, every count, offset and index, the whole graph.
/// SL_BAD_INPUT, naming the file, on any fault, and for a shard. `out` must be empty; on failure it
/// stays so.
SL_API sl_status sl_baked_read(sl_context *context, const char *path, sl_baked *out);

/// As sl_baked_read, and takes shards too.
SL_API sl_status sl_baked_read_part(sl_context *context, const char *path, sl_baked *out);

/// As sl_baked_read from memory, which is only read; `name` is for messages.
SL_API sl_status sl_baked_parse(sl_context *context, const char *name, const void *bytes,
                                size_t size, sl_baked *out);

/// What an export needs beside the baked file. Zeroed: nothing.
typedef struct sl_export_options {
    const char *wad; ///< "reject": the WAD that holds the map that was baked
    const char *map; ///< "reject": that map's name
} sl_export_options;

/// An export for other programs.
typedef struct sl_export_format {
    const char *name, *what;
    bool takes_wad; ///< the options `wad` and `map` are for it
    sl_status (*write)(sl_context *context, const sl_baked *baked, const sl_export_options *options,
                       const char *path);
} sl_export_format;

/// The formats that the context knows; the first is the default. By itself it knows those below;
/// sl_io_use() of sightline/io.h adds others.
SL_API const sl_export_format *sl_export_formats(const sl_context *context, size_t *count);

/// Adds formats, which are copied; one whose name is there already is passed over.
SL_API sl_status sl_export_formats_add(sl_context *context, const sl_export_format *more,
                                       size_t count);

/// "json": one object with walls, cells, portals and visible sets.
SL_API sl_status sl_export_json(sl_context *context, const sl_baked *baked,
                                const sl_export_options *options, const char *path);
/// "csv": a line "from,to" for each ordered pair seen.
SL_API sl_status sl_export_csv(sl_context *context, const sl_baked *baked,
                               const sl_export_options *options, const char *path);
/// "c": a C header with the matrix, a bit a pair.
SL_API sl_status sl_export_c(sl_context *context, const sl_baked *baked,
                             const sl_export_options *options, const char *path);

#ifdef __cplusplus
}
#endif

#endif
