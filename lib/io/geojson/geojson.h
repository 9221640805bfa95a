/// The parts of the reader of GeoJSON. Files are walked once (geojson_walk.c), into features with
/// their points. Then the points are laid in a plane, and each feature gets its meaning and its
/// levels (geojson_means.c, geojson_levels.c, geojson_storeys.c). Doors are cut out of the walls
/// last (geojson_doors.c).
#ifndef SL_GEOJSON_H
#define SL_GEOJSON_H

#include "io/parts/document.h"
#include "sightline/import.h"
#include "sightline/support.h"

typedef enum sli_geo_meaning {
    SLI_GEO_UNSAID, ///< nothing that is known
    SLI_GEO_WALL,   ///< its lines and outlines are walls
    SLI_GEO_DOOR,
    SLI_GEO_MIRROR,
    SLI_GEO_ONEWAY,
    SLI_GEO_START,
    SLI_GEO_WAY,     ///< a street, a river, a meadow: no wall
    SLI_GEO_NO_WALL, ///< what is known to be none: levels, furniture, cells of a baked file
} sli_geo_meaning;

/// A run of points: a point, a line, or a ring, whose last point is the first one again.
typedef struct sli_geo_line {
    size_t first, count;
    bool ring; ///< of a polygon
} sli_geo_line;

/// Texts belong to the tree of the file.
typedef struct sli_geo_feature {
    json_t *feature, *properties; ///< NULL for a geometry without a feature
    sli_geo_meaning means;
    const char *layer;   ///< the word that says what it is; "" for none
    const char *by_file; ///< the word that its file's name says; "" for none
    size_t first, count; ///< of its lines
    bool taken;
} sli_geo_feature;

enum { SLI_GEO_FILES = 4 };

typedef struct sli_geo {
    sl_context *context;
    const char *name;
    const sl_import_options *options;
    sl_map *map;
    sli_json_file files[SLI_GEO_FILES]; ///< the file itself, and those of a set beside it
    size_t file_count;
    char beside[SLI_GEO_FILES][64]; ///< names of those, as long as messages may name them
    const char *by_file;            ///< of the features that are being read
    SL_ARRAY(sli_geo_feature) features;
    SL_ARRAY(sli_geo_line) lines;
    SL_ARRAY(sl_point) points; ///< as in the file, then in the map
    SL_ARRAY(size_t) levels;   ///< features that say where a level stands
    const char *level_key;     ///< the property that names storeys; NULL for the usual ones
    double finest;             ///< the last decimal place of the coordinates
    size_t no_walls;           ///< doors that are on no wall, left out
    size_t cuts;               ///< openings in walls
    bool guessed;              ///< nothing says what is a wall
    bool without_rings;        ///< they are left out
} sli_geo;

/// Reads the file, and those that belong to it. `sli_geo_close` is the caller's, also on failure.
sl_status sli_geo_open(sli_geo *geo, const char *text, size_t size);
void sli_geo_close(sli_geo *geo);

/// Lays all points in the map's plane, and says so. Sets the map's unit and its place on the earth.
sl_status sli_geo_place(sli_geo *geo);

/// Finds out what each feature is.
sl_status sli_geo_find_meanings(sli_geo *geo);
/// What the features that are taken as walls mean: walls; where none does, nothing that is known;
/// where all say something else, that they are none.
sli_geo_meaning sli_geo_means_walls(const sli_geo *geo);

/// Looks for the property that says on which storey a feature is, where none says it in the usual
/// way: geo->level_key.
sl_status sli_geo_find_storeys(sli_geo *geo);
/// Tells where outlines that are taken lie on each other as storeys do.
sl_status sli_geo_note_storeys(const sli_geo *geo);

enum { SLI_GEO_LEVEL_TEXT = 64 };
/// A number or a text as the name of a level; "" for none.
void sli_geo_value(const json_t *value, char text[SLI_GEO_LEVEL_TEXT]);

/// The names of all levels that walls and doors are on, lowest first; none where nothing has a
/// level.
sl_status sli_geo_levels(sli_geo *geo, sl_map_list *list);
/// Whether a feature is on a level; one that has none is on all.
bool sli_geo_on_level(const sli_geo *geo, const sli_geo_feature *feature, const char *level);

/// SL_BAD_INPUT where there are points, and no lines.
sl_status sli_geo_refuse_points(const sli_geo *geo);
/// SL_BAD_INPUT where open lines that nothing names reach too far for walls. Notes sites that lie
/// far apart, with the --crop of each. For maps on the earth, once it is known what is taken.
sl_status sli_geo_doubt(const sli_geo *geo);
/// Beside outlines of rooms, entrances may be areas as rooms are: these are no doors.
sl_status sli_geo_find_halls(sli_geo *geo);
/// Whether what is taken is a plan of rooms, and no town: buildings, or more than a house is long.
bool sli_geo_is_plan(const sli_geo *geo);
/// Footprints of buildings in a map projection whose unit nothing says: what they enclose is
/// inside, not the streets among them. Sets the width of the map's entrances, and says so.
sl_status sli_geo_look_for_footprints(const sli_geo *geo);

/// Tells where units of IMDF leave much of their level open, and how its outline is taken.
void sli_geo_note_levels(const sli_geo *geo);

/// Keeps the names of rooms, as texts of the map.
sl_status sli_geo_add_names(sli_geo *geo);

/// Adds the doors that are taken: they are cut out of the map's walls, or stand between them.
sl_status sli_geo_add_doors(sli_geo *geo);

/// Whether a word says that a feature is a building.
bool sli_geo_says_building(const char *word);

/// A property of a feature, also one among the "tags" of OpenStreetMap; NULL for none.
json_t *sli_geo_property(const sli_geo_feature *feature, const char *key);
/// The text of a property; "" for none.
const char *sli_geo_text(const sli_geo_feature *feature, const char *key);

#endif
