/// The map: walls and all else that a plan holds, as read, before any subdivision.
#ifndef SIGHTLINE_MAP_H
#define SIGHTLINE_MAP_H

#include "sightline/context.h"
#include "sightline/earth.h"
#include "sightline/geometry.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What the ground beside a wall is, as bits of sl_wall.ground; left and right going from a to b.
/// Unmarked ground is open unless solid ground reaches it without a wall between, or polygons of
/// solid ground cover it.
enum {
    SL_SOLID_LEFT = 1,  ///< solid ground, such as rock: nobody stands there
    SL_SOLID_RIGHT = 2, ///< as SL_SOLID_LEFT, at the right
    SL_OPEN_LEFT = 4,   ///< open ground: the map contradicts itself where solid ground reaches it
    SL_OPEN_RIGHT = 8,  ///< as SL_OPEN_LEFT, at the right
    /// Solid ground begins at the wall, going from its right to its left: how often, as a number
    /// times 32 that may be below 0, in the bits from here on. It tells a hole in a polygon from a
    /// hole that another polygon covers. Readers of single walls leave it 0.
    SL_SOLID_BEGINS = 32,
};

/// The ground of a wall whose ends are exchanged.
static inline uint32_t sl_ground_turned(uint32_t ground) {
    return (ground & (SL_SOLID_LEFT | SL_OPEN_LEFT)) << 1 |
           (ground & (SL_SOLID_RIGHT | SL_OPEN_RIGHT)) >> 1 | (0 - (ground & ~31u));
}

/// What a wall stops, as bits. Light is sight.
enum {
    SL_STOPS_SIGHT = 1,
    SL_STOPS_STEPS = 2,
    SL_STOPS_SOUND = 4,
    SL_STOPS_ALL = 7,
    /// A limited wall: sight passes one of them, and not a second one. Not with SL_STOPS_SIGHT.
    SL_STOPS_LIMITED = 8,
};

/// A wall: a closed segment that stops sight, steps and sound. `line`, here and below, is the line
/// of the file, or the number of an item where the map says so (sl_map_source.lines_are_items); 0
/// for none.
typedef struct sl_wall {
    sl_point a, b;
    uint32_t line;
    uint32_t ground; ///< bits of SL_SOLID_LEFT ...; 0 for most maps
} sl_wall;

/// What a door is. The library opens and shuts all of them; games keep to it (the runtime header).
typedef enum sl_door_kind {
    SL_DOOR_PLAIN,     ///< opens and shuts
    SL_DOOR_BREAKABLE, ///< a wall that breaks: once open, it stays open
    SL_DOOR_SITE,      ///< a place for a wall: once shut, it stays shut
} sl_door_kind;

/// A door: a portal that can be shut. Doors of one name are parts of one door, which open and shut
/// together.
typedef struct sl_door {
    char *name;
    sl_segment segment;
    bool open;
    sl_door_kind kind;
    uint32_t line;
    sl_segment *parts; ///< the parts that cleaning cut it into, in order; NULL for a whole one
    size_t part_count;
} sl_door;

/// A mirror; one-way glass, seen through from its right to its left, going from a to b; or a seam,
/// a line that cuts the cells. A seam is passed by all, or it is a wall that does not stop all.
typedef struct sl_glass {
    sl_segment segment;
    uint32_t line;
    bool one_sided; ///< for a mirror: it reflects on its left only, going from a to b
    bool entrance;  ///< for a seam: what is inside ends there (sl_map_find_inside)
    uint8_t stops;  ///< for a seam: what it stops, as bits of SL_STOPS_SIGHT ...; 0 for most
    uint8_t ground; ///< of such a wall: bits of SL_SOLID_LEFT ... (sl_map_walls_stop)
} sl_glass;

/// A viewpoint. The heading is in degrees, counter-clockwise from +x.
typedef struct sl_start {
    sl_point at;
    double heading;
    uint32_t line;
} sl_start;

/// A way through the map, as a polyline.
typedef struct sl_path {
    char *name;
    sl_point *points;
    size_t count; ///< at least 1
    uint32_t line;
} sl_path;

/// An object: a box to be culled.
typedef struct sl_object {
    char *name;
    sl_box box;
    uint32_t line;
} sl_object;

/// A cell that the map brings along: corners[first .. first + count), in either direction.
typedef struct sl_map_cell {
    size_t first;
    uint32_t count; ///< at least 3
    uint32_t line;
} sl_map_cell;

/// The name that the file itself has for one of its lines or items.
typedef struct sl_label {
    uint32_t line;
    uint32_t text; ///< where it begins in label_text
} sl_label;

/// A comment of a map text, with its '#', or an empty line after one. It belongs to the statement
/// on `line`; 0: to the first line, UINT32_MAX: to the end of the file.
typedef struct sl_comment {
    char *text;
    uint32_t line;
    bool behind; ///< on the same line as the statement; else on a line of its own before it
} sl_comment;

/// A text of a drawing, where it begins.
typedef struct sl_map_text {
    char *text; ///< one line of UTF-8, not empty
    sl_point at;
    double height; ///< of its letters, in the map's unit; 0: unknown
} sl_map_text;

/// How it is known how wide entrances are.
typedef enum sl_entrance {
    SL_ENTRANCE_NONE,  ///< it is not
    SL_ENTRANCE_GIVEN, ///< the map says it (sl_map.entrance)
    SL_ENTRANCE_UNIT,  ///< usual entrances, in the map's unit
    SL_ENTRANCE_FOUND, ///< by the openings of the map itself
    SL_ENTRANCE_DOORS, ///< by the doors of the map (sl_map.entrance_by_doors)
    SL_ENTRANCE_WIDE,  ///< an opening somewhat wider than these, without which inside is doubtful
} sl_entrance;

/// What is inside of a map without starts, as sl_map_find_inside has found it. Zeroed: not found.
typedef struct sl_interior {
    sl_entrance by;
    double width;     ///< of entrances: what a disc that wide cannot enter is inside; 0 for none
    sl_point *places; ///< one in each part that is inside, the roomiest part first
    size_t place_count;
    size_t entrances;      ///< openings where what is inside ends
    bool building;         ///< a third of the walls or more have what is inside on one side
    double doubtful_width; ///< of an opening that may be an entrance, too, with three digits,
                           ///< rounded up; 0 for none
    sl_segment doubtful;   ///< where it is
    sl_point roomiest;     ///< a place far from walls: one that is inside, else behind the doubtful
                           ///< opening, else one with an opening that is narrow for the map, else
                           ///< any. NAN where none was looked for: the map has starts or solid
                           ///< ground
} sl_interior;

/// How the places of a map stand in other coordinates: a file's, or a screen's. The point (x, y) of
/// the map is scale * (x - origin.x), scale * (y - origin.y) there, or scale * (origin.y - y) if y
/// points down there. A scale of 0: it is not known.
typedef struct sl_transform {
    sl_point origin; ///< the place in the map that is 0, 0 there
    double scale;    ///< units there in a unit of the map
    bool y_down;
} sl_transform;

/// What the file of a map says beside the map. Walls, cells and sight do not depend on it.
typedef struct sl_map_source {
    char *name;           ///< of the file, for messages; NULL for none
    bool lines_are_items; ///< `line` counts the items of a file without lines (JSON, WAD), from 1
    char *notes;          ///< notices that stay with the map, in lines; NULL for none
    /// How the map's places stand in the file. All readers set it; .slv files keep it, map text
    /// does not.
    sl_transform transform;
    /// The page of a file with y down, in the map's places, so that a writer can put all back in
    /// its place. An empty box stands for none. Map text and .slv files do not keep it.
    sl_box page;
    double pixels;    ///< of the program that the file is from, in a unit of the map; 0: unknown
    int drawing_unit; ///< of a DXF drawing, by its $INSUNITS; 0 for none. Kept as the page is
    uint32_t plans;   ///< on a sheet that was read whole; 0 for one map. Kept as the page is
    bool joined; ///< doors of a drawing lead between what would be plans of a sheet: it is one map
    /// What the file calls its lines, by ascending line: layers, handles, ids. Map text and .slv
    /// files do not keep them. Equal texts that follow each other stand in label_text once.
    sl_label *labels;
    char *label_text;
    size_t label_count, label_length, label_room, label_text_room;
    sl_comment *comments; ///< of a map text, in its order; .slv files do not keep them
    size_t comment_count, comment_room;
    sl_map_text *texts; ///< of a drawing, in its order; map text and .slv files do not keep them
    size_t text_count, text_room;
} sl_map_source;

/// All arrays belong to the map. A zeroed map is empty.
typedef struct sl_map {
    sl_map_source source;
    sl_wall *walls;
    sl_door *doors;
    sl_glass *mirrors;
    sl_glass *oneways;
    sl_glass *seams;
    sl_start *starts;
    sl_path *paths;
    sl_object *objects;
    size_t wall_count, door_count, mirror_count, oneway_count, seam_count;
    size_t start_count, path_count, object_count;
    size_t wall_room, door_room, mirror_room, oneway_room, seam_room;
    size_t start_room, path_room, object_room;
    /// Cells of the map's own, for the subdivision "given"; cell_count is 0 for most maps.
    sl_map_cell *cells;
    sl_point *corners;
    size_t cell_count, corner_count, cell_room, corner_room;
    double snap; ///< corners of cells and ends of walls within this distance of each other, or of a
                 ///< side or wall, are one place with it
    uint32_t snap_line;
    /// How far apart two writings of one place may be by the digits of the map's file, in map
    /// units; 0 for a map whose numbers are exact. Readers of drawings set it, cleaning sets it
    /// back to 0.
    double precision;
    /// What the file says its coordinates are in: "m", "mm", "ft", "px" ...; "" where it does not
    /// say. Entrances are as wide as is usual in it (sl_map_find_inside). Map text and .slv files
    /// keep units of a known length, and what a map text says itself.
    char unit[16];
    uint32_t unit_line;
    /// Where the map lies on the earth, if it was read from longitudes and latitudes: its unit is
    /// "m" then. GeoJSON is written in degrees again. Map text and .slv files keep it.
    sl_earth earth;
    uint32_t earth_line;
    double entrance; ///< how wide openings to the outside are at most; 0 where nobody says it
    uint32_t entrance_line;
    /// Nobody says `entrance`: doors that are drawn open tell it. So it counts where the width that
    /// is found is narrower than doors, and wider openings are doubtful then.
    bool entrance_by_doors;
    /// A plan drawn for people: an opening somewhat wider than entrances is one, where inside would
    /// be doubtful without it. Readers of drawings set it; map text and .slv files do not keep it.
    bool entrance_may_be_wide;
    sl_interior interior; ///< map text and .slv files do not keep it
    /// Which walls a space of the map has: those that stop one of these, as bits of SL_STOPS_SIGHT
    /// ...; 0: those that stop sight. Others are open there. Map text does not keep it.
    uint32_t channel;
    double range; ///< the view range; 0 for no limit
    uint32_t range_line;
    bool ground_guessed; ///< the reader found the walls' ground by rules of thumb: where they
                         ///< contradict each other, ground is open
} sl_map;

SL_API void sl_map_destroy(sl_context *context, sl_map *map); ///< and zeroes it

/// A deep copy into an empty map, which stays empty on failure.
SL_API sl_status sl_map_copy(sl_context *context, const sl_map *from, sl_map *to);

/// Each adds one thing, and copies its arguments. A coordinate of a magnitude below
/// SL_COORDINATE_MIN becomes 0. SL_BAD_ARGUMENT if one is above SL_COORDINATE_MAX, or no number.
SL_API sl_status sl_map_add_wall(sl_context *context, sl_map *map, sl_point a, sl_point b,
                                 uint32_t line);
/// Adds copies of walls, with their lines and their ground. As sl_map_add_wall.
SL_API sl_status sl_map_add_walls(sl_context *context, sl_map *map, const sl_wall *walls,
                                  size_t count);
/// Adds a polygon of solid ground: its sides as walls with solid ground at one hand. Corners, at
/// least 3, go either way round. Solid polygons may overlap, touch and lie in one another: solid is
/// what any of them covers. SL_BAD_INPUT, with the line, if the polygon has no area or its sides
/// cross each other. As sl_map_add_wall.
SL_API sl_status sl_map_add_solid(sl_context *context, sl_map *map, const sl_point *corners,
                                  size_t count, uint32_t line);
/// Adds a polygon of open ground that is cut out of solid ground: its sides as walls with solid
/// ground outside. As sl_map_add_solid; open polygons may not overlap each other. They may share
/// parts of their sides.
SL_API sl_status sl_map_add_open(sl_context *context, sl_map *map, const sl_point *corners,
                                 size_t count, uint32_t line);
/// Says that the walls from number `first` on stop these alone (bits of SL_STOPS_SIGHT ...,
/// SL_STOPS_LIMITED among them). They become seams of the map (sl_glass.stops), those of no length
/// are dropped; with SL_STOPS_ALL they stay. Polygons of ground keep their marks, but the ground is
/// open for all: one sees from there, and over it. It is not inside if the walls stop steps.
/// SL_BAD_ARGUMENT for 0 and for other bits.
SL_API sl_status sl_map_walls_stop(sl_context *context, sl_map *map, size_t first, uint32_t stops);

/// Walls that stop what a space of the map is for (sl_map.channel) stop all then, and those that do
/// not are left out. *left_out, which may be NULL, is their number.
SL_API sl_status sl_map_settle_stops(sl_context *context, sl_map *map, size_t *left_out);
/// How many walls do not stop all.
SL_API size_t sl_map_partial_walls(const sl_map *map);
/// How many walls limit sight (SL_STOPS_LIMITED) where a space of the map is one of sight; else 0.
SL_API size_t sl_map_limited_walls(const sl_map *map);
/// Whether, in a map whose space is one of sight, some walls stop steps and not sight, or sight and
/// not steps. Paths then need a space of their own: that of a copy with the channel SL_STOPS_STEPS.
SL_API bool sl_map_steps_differ(const sl_map *map);

/// Room for what sl_stops_write writes.
#define SL_STOPS_TEXT 24
/// What is stopped, as map text says it: "sight,steps"; "" for 0.
SL_API void sl_stops_write(uint32_t stops, char text[SL_STOPS_TEXT]);
/// Reads such a text of `length` characters; false where it is none, names a thing twice, or has
/// both "sight" and "limited".
SL_API bool sl_stops_read(const char *text, size_t length, uint32_t *out);
/// What a space of the map lets its walls stop (sl_map.channel), never 0.
static inline uint32_t sl_map_channel(const sl_map *map) {
    return map->channel ? map->channel : (uint32_t)SL_STOPS_SIGHT;
}

/// Adds a door, a plain one. As sl_map_add_wall.
SL_API sl_status sl_map_add_door(sl_context *context, sl_map *map, const char *name, sl_segment at,
                                 bool open, uint32_t line);
/// Adds a mirror that reflects on both sides. As sl_map_add_wall.
SL_API sl_status sl_map_add_mirror(sl_context *context, sl_map *map, sl_segment at, uint32_t line);
/// Adds one-way glass, seen through from its right to its left. As sl_map_add_wall.
SL_API sl_status sl_map_add_oneway(sl_context *context, sl_map *map, sl_segment at, uint32_t line);
/// Adds a seam. As sl_map_add_wall.
SL_API sl_status sl_map_add_seam(sl_context *context, sl_map *map, sl_segment at, uint32_t line);
/// Adds a viewpoint; its heading in degrees, counter-clockwise from +x. As sl_map_add_wall.
SL_API sl_status sl_map_add_start(sl_context *context, sl_map *map, sl_point at, double heading,
                                  uint32_t line);
/// Adds a path of `count` points, at least 1. As sl_map_add_wall.
SL_API sl_status sl_map_add_path(sl_context *context, sl_map *map, const char *name,
                                 const sl_point *points, size_t count, uint32_t line);
/// Adds an object. As sl_map_add_wall.
SL_API sl_status sl_map_add_object(sl_context *context, sl_map *map, const char *name, sl_box box,
                                   uint32_t line);
/// Adds a cell of `count` corners, either way round. A corner where the one before it is, is left
/// out; at least 3 must remain. As sl_map_add_wall.
SL_API sl_status sl_map_add_cell(sl_context *context, sl_map *map, const sl_point *corners,
                                 size_t count, uint32_t line);
/// Drops the map's own cells.
SL_API void sl_map_drop_cells(sl_context *context, sl_map *map);
/// Room for what sl_map_say_line writes.
#define SL_LINE_TEXT 160

/// Writes where a line is, for people: "line 12", "line 12 (layer WALLS, handle 1F)", "linedef
/// 117"; nothing for line 0.
SL_API void sl_map_say_line(const sl_map *map, uint32_t line, char text[SL_LINE_TEXT]);

/// The file's own name for a line; NULL for none.
SL_API const char *sl_map_label(const sl_map *map, uint32_t line);

/// Finite, and 0 or of a magnitude between SL_COORDINATE_MIN and SL_COORDINATE_MAX.
SL_API bool sl_coordinate_usable(double value);

/// The smallest box around all things of the map; {{0,0},{0,0}} for an empty map.
SL_API sl_box sl_map_bounds(const sl_map *map);

/// How many significant digits tell places apart that are a millionth of the map's size apart: 6 to
/// 17. The size is that of the bounds, or the length of all walls where that is less.
SL_API int sl_map_digits(const sl_map *map);

/// Whether all walls, mirrors, doors, one-way glass and seams are parallel to an axis.
SL_API bool sl_map_is_axial(const sl_map *map);

/// What sl_map_crop() did. Lines are walls, mirrors, glass and seams. The numbers below them are of
/// what was left out: doors, starts, paths, objects and cells of the map's own.
typedef struct sl_crop_account {
    size_t inside, cut, left_out; ///< lines
    size_t doors, starts, paths, objects, cells;
} sl_crop_account;

/// Keeps what lies in a box, given by two opposite corners; the border belongs to it. Lines, doors
/// and paths are cut where they cross the border: which do is exact, and the place is the nearest
/// one that doubles have, on the border. What only touches the border from outside is left out. Of
/// a path several parts may stay, each with its name; cells of the map's own stay where they are
/// whole. A door that was cut by cleaning is one door again.
///
/// Polygons of ground are cut as polygons: their outlines go on along the border, so ground stays
/// what it is. Ground of single marked walls is known where such a wall is in the box.
///
/// `account` may be NULL. SL_BAD_ARGUMENT if the box has no area or its corners are no coordinates.
/// On failure the map stays as it was. A map may be empty then; that is no failure. Time O(n log n)
/// for n walls that cross the border, and linear in all else.
SL_API sl_status sl_map_crop(sl_context *context, sl_map *map, sl_box box,
                             sl_crop_account *account);

/// What cleaning did, as numbers of walls unless said otherwise.
typedef struct sl_clean_account {
    size_t before, after;
    size_t zero_length;  ///< dropped
    size_t duplicate;    ///< dropped: the same two ends as another wall
    size_t merged;       ///< joined with a wall in the same line that they overlap or touch
    size_t split;        ///< cut where another wall crosses or touches them
    size_t welded;       ///< ends of walls, doors, glass and seams that moved to another end
    size_t crossings;    ///< points where walls cross that had to be computed
    double largest_move; ///< the largest distance of a clean wall from the walls it comes from
    double tolerance;    ///< ends at most this far apart became one
} sl_clean_account;

/// Start from sl_clean_options_default().
typedef struct sl_clean_options {
    /// Ends at most this far apart become one, and a wall nearer than half of it to an end goes
    /// through this end. 0: only equal ends become one, and only an end exactly on a wall counts.
    ///
    /// Negative (default): the larger of two. One is 2^-46 of the largest coordinate if something
    /// is oblique, else 0. It closes the gaps that turning and moving a map in doubles opens. The
    /// other is the map's `precision`, cut to 1/1000 of the map's longer side and to half of the
    /// shortest wall, door, glass or seam. Anything shorter than both the precision and 1/100000
    /// of the map counts as rounding there, and not as the shortest.
    double weld;
} sl_clean_options;

/// The usual options, as told at each field.
SL_API sl_clean_options sl_clean_options_default(void);

/// Makes the walls a planar set: no two of them cross, overlap or touch, except in common ends, by
/// exact predicates. Each mirror also becomes a wall, which hides what is behind it. Walls with
/// solid ground at both sides are dropped. Walls are sorted by place. All later stages are exact
/// for the clean map.
///
/// If all is axial and welding by default would move nothing, no coordinate is computed: walls in
/// one line that overlap or touch are joined, and walls are split where they cross or touch. Else
/// doors, glass and seams are made planar together with the walls: ends are welded, and crossing
/// walls are split at the nearest representable point. A door that is cut has `parts`; mirrors,
/// glass and seams become several. A sightline that stays farther than `largest_move` from every
/// wall as read is never lost.
///
/// Sides of the map's own cells take part, as seams do. The tolerance is then at least twice the
/// map's `snap`. Cells of which nothing is left are dropped.
///
/// Doors, mirrors, one-way glass and seams whose ends are one place, as read or by welding, are
/// left out; a note names each by its line. The other doors keep their order.
///
/// Cleaning a clean map again moves nothing. It may join walls in one line that welding left apart.
///
/// NULL options are the default ones; `account` may be NULL. SL_UNSUPPORTED if walls cross again
/// each time that a crossing is rounded; a tolerance below the rounding of doubles may cause this.
/// Time O((n + k) log n) for k meeting points.
SL_API sl_status sl_map_clean(sl_context *context, sl_map *map, const sl_clean_options *options,
                              sl_clean_account *account);

#ifdef __cplusplus
}
#endif

#endif
