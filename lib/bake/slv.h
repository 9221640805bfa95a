/// The layout of a baked file (.slv).
///
/// A header, a table of sections, then the sections, each at a multiple of 8 bytes from the file's
/// start, zeros between. Numbers are little endian (slv_order.c), which the header says once more.
/// The checksum is zlib's CRC-32 of all bytes of the file, its own four taken as 0. Readers pass
/// over sections whose tag they do not know.
#ifndef SL_SLV_H
#define SL_SLV_H

#include "base/base.h"
#include "sightline/bake.h"

#include <stdio.h>

#define SLI_SLV_MAGIC "\x89SLV\r\n\x1a\n"
/// Files of meshes; and those of kd-trees, which have stayed as they were. Files of version 1 that
/// have a section BEYO were made by a BSP, whose cells may overlap by rounding: they are read, and
/// a grid is made for them.
#define SLI_SLV_VERSION       2u
#define SLI_SLV_VERSION_AXIAL 1u
/// From this bit on, items of STOP have the ground of a wall.
#define SLI_SLV_GROUND     8
#define SLI_SLV_BYTE_ORDER 0x01020304u

typedef struct sli_slv_header {
    char magic[8];
    uint32_t version, byte_order;
    uint64_t file_bytes;
    uint32_t section_count, checksum;
} sli_slv_header;

typedef struct sli_slv_section {
    char tag[4];
    uint32_t item_bytes;
    uint64_t offset; ///< from the file's start
    uint64_t count;  ///< of items
} sli_slv_section;

/// Section INFO, one item.
typedef struct sli_slv_info {
    double bounds[4]; ///< min x, min y, max x, max y
    int32_t root;     ///< as a child of a node
    uint32_t tree_depth, inside_count;
    uint32_t sight, guarantee; ///< of sl_sight, sl_guarantee
    uint32_t unused;           ///< 0
    uint32_t trees_left_out;
    uint32_t loose;                   ///< as in sl_space
    uint32_t grid_columns, grid_rows; ///< 0 for a kd-tree
    uint64_t unused_count;            ///< 0
    uint64_t pairs, doubtful_pairs;
    char method[16], solver[16]; ///< as sli_slv_is_name
} sli_slv_info;

/// Section PART, one item, of a bake that is not finished. INFO then says conservative (but rounded
/// of a rounded method), so that who does not know this section takes the sets for what they are.
typedef struct sli_slv_part {
    uint32_t shard, shard_count; ///< 0, 0 where it is no shard
    uint32_t unit_count;
    uint32_t inside_only; ///< 0 or 1
} sli_slv_part;

/// Section PAEF, one item, where such a bake is of a map with effects: under which they were looked
/// for. What was found: FNMO and FNMB by mirror, FNEO and FNEB the sets of doors, FNXO and FNXB
/// those of pairs seen by mirror.
typedef struct sli_slv_part_effects {
    uint32_t effects, mirror_depth, door_limit;
    uint32_t rounded; ///< 0 or 1
} sli_slv_part_effects;

/// The other sections: NODE, CELL, VERT, PORT, EXIT hold the arrays of sl_space item by item, WALL
/// its walls as segments. Files of meshes alone have BEYO, what is beyond the cells' sides, and
/// GRIO and GRIC, the offsets and cells of the grid's buckets; their NODE is empty. Files of
/// kd-trees have NODG and NODS, columns and rows and the starts of sli_tree_grid. SEAM has the
/// seams and SEPO the portals on them (only if there are any); PVSO and PVSB are the offsets and
/// bytes of the visible sets, PVSP beside them as sli_pvs_parts, DBTO and DBTB those of the
/// doubtful pairs (only if there are any), MIRO and MIRB those of what is seen by mirror, DORO and
/// DORB the offsets and bytes of the sets of doors, MDOO and MDOB those of pairs seen by mirror
/// (each only if there are any), TREO and TREN the offsets and nodes of the stab trees (only if
/// asked for; a node that names a mirror of the map, SL_STAB_MIRROR, is refused as no tree by
/// readers that do not know of these); MAPT is what the map holds beside its walls, as map text.
/// Beside PART there are DONE, a bit for each unit of the work that is done, in words of 64, and
/// the offsets and bytes of the pairs found by them: FNDO and FNDB, doubtful ones in FNRO and FNRB.
/// A shard has no PVSO and PVSB. What the work took (tests, nodes ...) is in no file: it would
/// depend on the way.
///
/// View cells (only with sightline viewcells --slv): VCIN has one sli_slv_views, VCEL the view cell
/// of each cell (32 bits, all set for none), VCPA the parent of each node (likewise), VCRO and VCRB
/// offsets and bytes of the nodes' rows, as PVSO and PVSB, with empty ones behind the last node so
/// that there are as many as cells. A view cell is the node of its number, and sees what its row
/// and those of the nodes above it hold. Where PVSO and PVSB are left out each cell sees what its
/// view cell does, and no node has one above; INFO then counts these pairs, and says conservative.
typedef struct sli_slv_views {
    uint32_t view_cell_count, node_count;
} sli_slv_views;

/// Section MAPI, one item. Files that have it hold what their map has in items too, so that games
/// read no text: MAPN the bytes of all names, one after another, DOOR, STRT, OBJE, PATH and PAPO
/// (the points of the paths), and MIRR, in the order of the map text. Each is there only if it has
/// items. The map text remains: what reads it does not need them. They are made from the map, and a
/// reader of the library refuses a file in which they are not those of its text. Older files have
/// none of these.
typedef struct sli_slv_map_info {
    double range;                     ///< 0 for none
    double origin_x, origin_y, scale; ///< as sl_transform
    uint64_t y_down;                  ///< 0 or 1
} sli_slv_map_info;

/// A name: bytes of MAPN.
typedef struct sli_slv_name {
    uint32_t first, bytes;
} sli_slv_name;

enum { SLI_SLV_DOOR_OPEN = 1, SLI_SLV_DOOR_BREAKABLE = 2, SLI_SLV_DOOR_SITE = 4 };

typedef struct sli_slv_door {
    sli_slv_name name;
    uint32_t state; ///< SLI_SLV_DOOR_OPEN ..., added up
} sli_slv_door;

typedef struct sli_slv_start {
    double x, y, heading;
} sli_slv_start;

typedef struct sli_slv_object {
    sli_slv_name name;
    sl_box box;
} sli_slv_object;

typedef struct sli_slv_path {
    sli_slv_name name;
    uint32_t first, count; ///< of its points
} sli_slv_path;

typedef struct sli_slv_mirror {
    sl_segment segment;
    uint64_t one_sided; ///< 0 or 1
} sli_slv_mirror;

_Static_assert(sizeof(sli_slv_map_info) == 40 && sizeof(sli_slv_door) == 12 &&
                   sizeof(sli_slv_start) == 24 && sizeof(sli_slv_object) == 40 &&
                   sizeof(sli_slv_path) == 16 && sizeof(sli_slv_mirror) == 40,
               "no padding in the file");

/// A section of the map's things.
typedef struct sli_slv_part_of_map {
    const char *tag;
    uint32_t item_bytes;
    uint64_t count;
    void *items;
} sli_slv_part_of_map;

enum { SLI_SLV_MAP_PARTS = 7 };

/// What a map holds in items. `parts` are all of them but `info`.
typedef struct sli_slv_things {
    sli_slv_map_info info;
    sli_slv_part_of_map parts[SLI_SLV_MAP_PARTS];
} sli_slv_things;

/// Makes the items of a map. SL_UNSUPPORTED if there are more than 32 bits can number, or
/// sli_slv_transform() would refuse its transform. To be destroyed, on failure as well.
sl_status sli_slv_things_make(sl_context *context, const sl_map *map, sli_slv_things *out);
void sli_slv_things_destroy(sl_context *context, sli_slv_things *things); ///< and zeroes it

/// SL_BAD_INPUT if a map that was read back has other items than the one that was written.
sl_status sli_slv_things_check_again(sl_context *context, const char *name, const sl_map *written,
                                     const sl_map *again);

/// The transform that a file has; false if it makes no sense.
bool sli_slv_transform(const sli_slv_map_info *info, sl_transform *out);

_Static_assert(sizeof(sli_slv_header) == 32 && sizeof(sli_slv_section) == 24 &&
                   sizeof(sli_slv_info) == 128 && sizeof(sli_slv_part) == 16 &&
                   sizeof(sli_slv_part_effects) == 16,
               "no padding in the file");
_Static_assert(sizeof(sl_node) == 24 && sizeof(sl_cell) == 24 && sizeof(sl_point) == 16 &&
                   sizeof(sl_portal) == 40 && sizeof(sl_directed_portal) == 40 &&
                   sizeof(sl_segment) == 32 && sizeof(sl_stab_node) == 12 &&
                   sizeof(sl_seam) == 40 && sizeof(sl_seam_portal) == 12,
               "no padding in the file");

/// Whether it is letters, digits and dashes, zeros behind: nothing that plays tricks on a terminal.
bool sli_slv_is_name(const char name[16]);

/// Whether this machine's numbers lie in memory as they do in the file.
bool sli_slv_is_native(void);
/// Turns items of a section from the machine's order of bytes to the file's, or back.
void sli_slv_order(const char *tag, uint32_t item_bytes, void *items, uint64_t count);
void sli_slv_order_header(sli_slv_header *header); ///< likewise
void sli_slv_order_entry(sli_slv_section *entry);  ///< likewise

/// What a writer reads back of its file: the header, the table of sections, the checksum of all
/// bytes, INFO, and the map text, whole and with as many things as `map`. Not the arrays of the
/// space and the visible sets: they are those in memory, which are checked as they are made, and to
/// read them again would take as much memory once more.
sl_status sli_slv_read_back(sl_context *context, const char *name, const sl_map *map,
                            sli_again *again);

/// An item of PASS.
typedef struct sli_slv_passage {
    uint32_t cell;
    uint32_t wall; ///< SL_NEIGHBOUR_RIGHT is or-ed to it if the cell is at its right
    uint32_t other, stops;
} sli_slv_passage;

/// The items of a space, by cell and then wall: two for each passage. The caller frees them.
sl_status sli_slv_list_passages(sl_context *context, const sl_space *space, sli_slv_passage **out);
/// Gives a space the passages of items that were read. sl_space_check looks at the rest.
sl_status sli_slv_take_passages(sl_context *context, const sli_slv_passage *items, uint64_t count,
                                sl_space *space, bool *sound);

#endif
