/// The baked file (.slv): a space and its visibility, for the tools and for games.
#ifndef SIGHTLINE_BAKE_H
#define SIGHTLINE_BAKE_H

#include "sightline/cell_to_cell.h"
#include "sightline/query.h"

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

/// How to bake a map. Start from sl_bake_options_default().
typedef struct sl_bake_options {
    sl_clean_options clean;
    const sl_subdivision *subdivision; ///< NULL: what the map's walls call for (sl_subdivision_for)
    sl_subdivide_options rules;        ///< of the kd-tree
    bool check;                  ///< check the space (sl_space_check); a mesh is always checked
    const sl_see_method *method; ///< NULL: the fastest exact one (sl_see_method_for)
    sl_see_options see;          ///< its `plan` is not looked at; no solver: sl_funnel()
    uint32_t mirror_depth;       ///< reflections of a sightline at most, 0 to 16; 1 by default
    uint32_t door_limit;         ///< sets of doors kept of a pair at most; 16 by default, 0: none

    /// Work unit by unit, so that `see.enough` can stop the bake and `see.shard` can share it. The
    /// result is the same; of a bake that is stopped, and of a shard, sl_baked.partial is kept. For
    /// methods that have units (sl_see_method.run), without stab trees.
    bool by_units;
    void *user; ///< of the functions below, each of which may be NULL
    /// Called when the map is cut into cells. `options` are those of the bake, with the method that
    /// is chosen and the plan: it may change `see` and `by_units`. It may fill `known`, which is
    /// zeroed, with partial results of the same space and options (sl_partial_reuse); with
    /// `by_units` they are not computed again.
    sl_status (*between)(sl_context *context, void *user, struct sl_bake_options *options,
                         const sl_baked *baked, sl_partial *known);
    /// Called when the units are done, with the outcome, which it may replace: processes that share
    /// a bake join what they found (sl_partial_merge). Where it leaves `partial` zeroed, the bake
    /// ends with neither visible sets nor partial results.
    sl_status (*join)(sl_context *context, void *user, sl_status outcome, sl_partial *partial);
} sl_bake_options;

/// What the command line does without options.
SL_API sl_bake_options sl_bake_options_default(void);

/// What a bake did, and how many seconds each stage took.
typedef struct sl_bake_account {
    sl_clean_account cleaning;
    const sl_subdivision *subdivision; ///< the one that was taken
    bool checked;                      ///< whether the space was checked
    /// The work by units; zeroed where the bake is done in one go.
    struct {
        const char *units; ///< what they are, plural
        uint32_t count, done;
        uint32_t known; ///< of `done`: before
    } work;
    struct {
        double clean, subdivide, check, see;
    } seconds;
} sl_bake_account;

/// What visible sets promise that a method found with this guarantee. They take limited walls
/// (SL_STOPS_LIMITED) as open: where the map has some, pairs may be added that are seen through two
/// of them.
SL_API sl_guarantee sl_limited_guarantee(const sl_map *map, sl_guarantee guarantee);

/// Bakes a map: cleans its walls, cuts the map into cells, finds which cells see which.
///
/// Takes the map over: on success it is empty, and `out` holds what it held. On failure `out` stays
/// empty, as it must be before, and the map may be cleaned or empty. `options` and `account` may be
/// NULL. Fails as the stages do: sl_map_clean, the subdivision, sl_see_check and the method.
///
///     sl_map map = {0};
///     sl_baked baked = {0};
///     if (sl_map_read(context, "office.map", NULL, &map) == SL_OK &&
///         sl_bake(context, &map, NULL, &baked, NULL) == SL_OK)
///         sl_baked_write(context, &baked, "office.slv");
SL_API sl_status sl_bake(sl_context *context, sl_map *map, const sl_bake_options *options,
                         sl_baked *out, sl_bake_account *account);

/// The first half alone: cleans and subdivides, for those who need no visible sets. It also
/// chooses: where `options` names no method or solver, it gets them. `account` may be NULL.
SL_API sl_status sl_bake_space(sl_context *context, sl_map *map, sl_bake_options *options,
                               sl_baked *out, sl_bake_account *account);

/// The same for questions that need no method: only `clean`, `subdivision`, `rules` and `check` of
/// the options count; NULL: the defaults. Takes the map over, as sl_bake does.
SL_API sl_status sl_bake_cells(sl_context *context, sl_map *map, const sl_bake_options *options,
                               sl_baked *out);
/// The cells of steps of what was cut for sight, where some walls stop the one and not the other
/// (sl_map_steps_differ); else `out` stays zeroed. Doors stand as those of `sight`.
SL_API sl_status sl_bake_steps(sl_context *context, const sl_baked *sight,
                               const sl_bake_options *options, sl_baked *out);

/// The map that a baked file was made from, but for comments, cells of its own and what else map
/// text alone keeps. `out` must be empty, and stays so on failure.
SL_API sl_status sl_baked_copy_map(sl_context *context, const sl_baked *baked, sl_map *out);

/// Whether reports and pictures count a cell: the bake looked from it, it is not solid ground, and
/// it is inside, where the map's starts say what inside is.
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

/// What is left to see with doors shut (by number, those of `shut` that are true): a space that has
/// walls in their place, and the visible sets without what is seen through them alone. Exact where
/// the bake was. Time and memory are about those of the visible sets. What is seen by mirror is
/// kept likewise. The new sets have no stab trees and no sets of doors.
SL_API sl_status sl_baked_shut(sl_context *context, const sl_baked *baked, const bool *shut,
                               sl_space *space, sl_visibility *visibility);

/// Writes beside the target and takes its place when all is written: SL_IO leaves the old file
/// intact. The bytes depend on the contents alone. SL_BAD_ARGUMENT where there is no visible set
/// for each cell, or a name that is none. SL_UNSUPPORTED where the map has a transform that readers
/// refuse: an origin beyond twice SL_COORDINATE_MAX, or a scale that is not 0 and not between
/// SL_COORDINATE_MIN and SL_COORDINATE_MAX. Reports stage "write".
SL_API sl_status sl_baked_write(sl_context *context, const sl_baked *baked, const char *path);

/// The same bytes in memory, which sl_baked_parse() reads. Fails as sl_baked_write() does, but for
/// SL_IO; `out` is untouched on failure.
SL_API sl_status sl_baked_print(sl_context *context, const sl_baked *baked, sl_bytes *out);

/// Reads and checks everything: the checksum, every count, offset and index, the whole graph.
/// SL_BAD_INPUT, naming the file, on any fault, and for a shard. `out` must be empty; on failure it
/// stays so.
SL_API sl_status sl_baked_read(sl_context *context, const char *path, sl_baked *out);

/// As sl_baked_read, and takes shards too.
SL_API sl_status sl_baked_read_part(sl_context *context, const char *path, sl_baked *out);

/// As sl_baked_read from memory, which is only read; `name` is for messages.
SL_API sl_status sl_baked_parse(sl_context *context, const char *name, const void *bytes,
                                size_t size, sl_baked *out);

// --- questions (sightline/query.h)

/// A query over a baked map, which must outlive it. SL_BAD_ARGUMENT for a shard.
SL_API sl_status sl_query_create(sl_context *context, const sl_baked *baked, sl_query **out);

/// The same for a baked file, which the query then owns. Fails as sl_baked_read does.
SL_API sl_status sl_query_open(sl_context *context, const char *path, sl_query **out);

// --- exports

/// What an export needs beside the baked file. Zeroed: nothing.
typedef struct sl_export_options {
    const char *wad;       ///< "reject": the WAD that holds the map that was baked
    const char *map;       ///< "reject": that map's name
    uint32_t json_version; ///< "json": 1 or 2; 0: the newest
    const char *prefix;    ///< "c": what names begin with; NULL: SL_PREFIX_DEFAULT
} sl_export_options;

/// What names of "c" begin with by default.
#define SL_PREFIX_DEFAULT "visible"
/// The longest prefix of "c".
#define SL_PREFIX_MOST 40

/// The newest version of "json" (lib/bake/EXPORT.md).
#define SL_JSON_VERSION 2

/// Which options a format takes.
typedef enum sl_export_takes {
    SL_EXPORT_TAKES_WAD = 1, ///< `wad` and `map`
    SL_EXPORT_TAKES_VERSION = 2,
    SL_EXPORT_TAKES_PREFIX = 4,
} sl_export_takes;

/// An export for other programs.
typedef struct sl_export_format {
    const char *name, *what;
    unsigned takes;     ///< bits of sl_export_takes
    bool shows_mirrors; ///< it has a place for mirrors and what they show
    sl_status (*write)(sl_context *context, const sl_baked *baked, const sl_export_options *options,
                       const char *path);
} sl_export_format;

/// The formats that the context knows; the first is the default. By itself it knows "json" (all
/// that a baked file holds, but for stab trees and notes), "geojson" (a FeatureCollection in the
/// map's own coordinates), "csv" (a line for each ordered pair seen) and "c" (a C header with
/// tables). lib/bake/EXPORT.md describes them. sl_io_use() of sightline/io.h adds others.
///
/// Writing fails with SL_UNSUPPORTED where a format has no place for what the map has (mirrors in
/// version 1 of "json"), and with SL_BAD_ARGUMENT for options that make no sense.
/// The table stays until formats are next added.
SL_API const sl_export_format *sl_export_formats(const sl_context *context, size_t *count);

/// Adds formats, which are copied; one whose name is there already is passed over.
SL_API sl_status sl_export_formats_add(sl_context *context, const sl_export_format *more,
                                       size_t count);

#ifdef __cplusplus
}
#endif

#endif
