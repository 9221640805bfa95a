/// The formats of sightline_io, and how a file of each is known by its first bytes.
#include "sightline/io.h"

#include "io/doom/wad.h"
#include "io/io_formats.h"
#include "map/scan.h"

#include <string.h>

static bool knows_svg(const char *text, size_t size) {
    (void)size;
    return *text == '<' && strstr(text, "<svg");
}

static bool is_one_of(const char *characters, char c) {
    return c && strchr(characters, c);
}

static bool knows_image(const char *text, size_t size) {
    return (size > 4 && memcmp(text, "\x89PNG", 4) == 0) ||
           (size > 3 && text[0] == 'P' && is_one_of("123456", text[1]) &&
            is_one_of(" \t\r\n#", text[2]));
}

static bool knows_tmx(const char *text, size_t size) {
    (void)size;
    return *text == '<' && strstr(text, "<map") && strstr(text, "tilewidth");
}

static bool begins_as_json(const char *text) {
    return is_one_of("{[", text[strspn(text, "\xef\xbb\xbf \t\r\n")]);
}

/// Whether the text begins as JSON does and has both words in quotation marks somewhere.
static bool is_json_with(const char *text, const char *word, const char *other) {
    return begins_as_json(text) && strstr(text, word) && strstr(text, other);
}

static bool knows_tmj(const char *text, size_t size) {
    (void)size;
    return is_json_with(text, "\"tilewidth\"", "\"layers\"") ||
           is_json_with(text, "\"tilelayer\"", "\"layers\"");
}

static bool knows_world(const char *text, size_t size) {
    (void)size;
    return is_json_with(text, "\"fileName\"", "\"world\"");
}

static bool knows_ldtk(const char *text, size_t size) {
    (void)size;
    return is_json_with(text, "\"__header__\"", "\"ldtk") ||
           is_json_with(text, "\"__header__\"", "LDtk");
}

static bool knows_uvtt(const char *text, size_t size) {
    (void)size;
    return is_json_with(text, "\"line_of_sight\"", "\"resolution\"");
}

/// Whether a word is a key somewhere, and its value begins so.
static bool has_member(const char *text, const char *key, const char *value) {
    for (const char *at = strstr(text, key); at; at = strstr(at + 1, key)) {
        const char *behind = at + strlen(key);
        behind += strspn(behind, " \t\r\n:");
        if (strncmp(behind, value, strlen(value)) == 0) return true;
    }
    return false;
}

/// An export names its format: "format": "sightline". Other files of ours have both words apart.
static bool knows_export(const char *text, size_t size) {
    static const char key[] = "\"format\"", value[] = "\"sightline\"";
    (void)size;
    return begins_as_json(text) && has_member(text, key, value);
}

/// Lists of walls with their corners. Other files have such words as texts.
static bool has_foundry_walls(const char *text) {
    return begins_as_json(text) && has_member(text, "\"walls\"", "[") &&
           has_member(text, "\"c\"", "[");
}

static bool knows_geojson(const char *text, size_t size) {
    (void)size;
    return is_json_with(text, "\"FeatureCollection\"", "\"features\"") ||
           is_json_with(text, "\"coordinates\"", "\"type\"");
}

static bool knows_foundry(const char *text, size_t size) {
    (void)size;
    return is_json_with(text, "\"c\"", "\"move\"") ||
           is_json_with(text, "\"walls\"", "\"padding\"") || has_foundry_walls(text) ||
           is_json_with(text, "\"_stats\"", "\"coreVersion\"") || // documents of other kinds:
           is_json_with(text, "\"prototypeToken\"", "\"items\"") ||
           is_json_with(text, "\"packs\"", "\"compatibility\"");
}

static bool knows_wad(const char *text, size_t size) {
    return sli_wad_known(text, size);
}

/// What files with layers of our own hold (layers.h).
#define KEEPS_LAYERS                                                                               \
    (SL_KEEPS_ALL & ~SL_KEEPS_NOTES & ~SL_KEEPS_COMMENTS & ~SL_KEEPS_UNIT & ~SL_KEEPS_ENTRANCE &   \
     ~SL_KEEPS_LIMITED & ~SL_KEEPS_EARTH)

/// Pairs of lines begin with a section, perhaps behind comments (999); or the file is binary; or a
/// DWG drawing of the same programs, which the reader refuses with what to do.
static bool knows_dxf(const char *text, size_t size) {
    static const char binary[] = "AutoCAD Binary DXF";
    if (size >= 6 && memcmp(text, "AC10", 4) == 0) return true;
    if (size >= sizeof binary && memcmp(text, binary, sizeof binary - 1) == 0) return true;
    sli_lines lines = sli_lines_of(text, size);
    for (sli_word code, value; sli_lines_next(&lines, &code) && sli_lines_next(&lines, &value);) {
        code = sli_trimmed(code);
        if (!sli_word_is(code, "999"))
            return sli_word_is(code, "0") && sli_word_is(sli_trimmed(value), "SECTION");
    }
    return false;
}

/// Whether a line begins with this key.
static bool has_key(const char *text, size_t size, const char *key) {
    const size_t length = strlen(key);
    sli_lines lines = sli_lines_of(text, size);
    for (sli_word line; sli_lines_next(&lines, &line);)
        if (line.length >= length && memcmp(line.at, key, length) == 0) return true;
    return false;
}

static bool knows_ros(const char *text, size_t size) {
    return has_key(text, size, "image:") && has_key(text, size, "resolution:");
}

static const sl_map_format map_formats[] = {
    {.name = "unigrafix",
     .endings = ".ug",
     .what = "a UniGrafix model, cut at a height",
     .read = sli_map_read_unigrafix,
     .heights = sli_map_heights_unigrafix,
     .takes = SL_TAKES_SLICE},
    {.name = "agp",
     .endings = ".pol",
     .what = "a polygon of AGPLIB, with holes",
     .read = sli_map_read_agp},
    {.name = "dxf",
     .endings = ".dxf",
     .what = "a DXF drawing",
     .read = sli_map_read_dxf,
     .takes =
         SL_TAKES_LAYERS | SL_TAKES_TOLERANCE | SL_TAKES_UNIT | SL_TAKES_DOORS | SL_TAKES_PLANS,
     .knows = knows_dxf,
     .write = sli_map_print_dxf,
     .keeps = (KEEPS_LAYERS & ~SL_KEEPS_RANGE & ~SL_KEEPS_CELLS) | SL_KEEPS_UNIT},
    {.name = "svg",
     .endings = ".svg",
     .what = "an SVG drawing",
     .read = sli_map_read_svg,
     .takes = SL_TAKES_LAYERS | SL_TAKES_TOLERANCE | SL_TAKES_DOORS | SL_TAKES_PLANS |
              SL_TAKES_THRESHOLD,
     .knows = knows_svg,
     .write = sli_map_print_svg,
     .keeps = KEEPS_LAYERS},
    {.name = "image",
     .endings = ".png .pgm .pbm .ppm",
     .what = "a picture: its dark pixels are solid",
     .read = sli_map_read_image,
     .takes = SL_TAKES_THRESHOLD | SL_TAKES_LAYERS,
     .knows = knows_image},
    {.name = "ros",
     .endings = ".yaml .yml",
     .what = "a map of ROS: a picture with its scale",
     .read = sli_map_read_ros,
     .takes = SL_TAKES_THRESHOLD,
     .knows = knows_ros},
    {.name = "tmx",
     .endings = ".tmx",
     .what = "a map of Tiled",
     .read = sli_map_read_tmx,
     .takes = SL_TAKES_LAYERS | SL_TAKES_TOLERANCE | SL_TAKES_STARTS | SL_TAKES_DOORS,
     .layers = sli_map_layers_tmx,
     .knows = knows_tmx,
     .write = sli_map_print_tmx,
     .keeps = KEEPS_LAYERS},
    {.name = "export",
     .endings = ".json",
     .what = "the map in an export of ours",
     .read = sli_map_read_export,
     .knows = knows_export},
    {.name = "tmj",
     .endings = ".tmj .json",
     .what = "a map of Tiled, as JSON",
     .read = sli_map_read_tmj,
     .takes = SL_TAKES_LAYERS | SL_TAKES_TOLERANCE | SL_TAKES_STARTS | SL_TAKES_DOORS,
     .layers = sli_map_layers_tmj,
     .knows = knows_tmj},
    {.name = "world",
     .endings = ".world",
     .what = "a world of Tiled: maps in files beside it",
     .read = sli_map_read_world,
     .takes = SL_TAKES_LAYERS | SL_TAKES_TOLERANCE | SL_TAKES_STARTS | SL_TAKES_DOORS,
     .list = sli_map_list_world,
     .knows = knows_world},
    {.name = "ldtk",
     .endings = ".ldtk .ldtkl .json",
     .what = "a project or a level of LDtk",
     .read = sli_map_read_ldtk,
     .takes = SL_TAKES_LAYERS | SL_TAKES_STARTS | SL_TAKES_DOORS,
     .list = sli_map_list_ldtk,
     .knows = knows_ldtk},
    {.name = "uvtt",
     .endings = ".dd2vtt .uvtt .df2vtt .json",
     .what = "a Universal VTT map",
     .read = sli_map_read_uvtt,
     .takes = SL_TAKES_LAYERS | SL_TAKES_DOORS,
     .knows = knows_uvtt,
     .write = sli_map_print_uvtt,
     .keeps = SL_KEEPS_DOORS | SL_KEEPS_STARTS | SL_KEEPS_RANGE},
    {.name = "foundry",
     .endings = ".json",
     .what = "a scene of Foundry VTT",
     .read = sli_map_read_foundry,
     .takes = SL_TAKES_LAYERS | SL_TAKES_DOORS | SL_TAKES_STARTS,
     .list = sli_map_list_foundry,
     .knows = knows_foundry,
     .write = sli_map_print_foundry,
     .keeps = SL_KEEPS_DOORS | SL_KEEPS_STARTS | SL_KEEPS_RANGE | SL_KEEPS_MIRRORS |
              SL_KEEPS_ONEWAYS | SL_KEEPS_SEAMS | SL_KEEPS_STOPS | SL_KEEPS_LIMITED},
    {.name = "foundry_db",
     .endings = ".db .ldb",
     .what = "a database of Foundry VTT: its scenes",
     .read = sli_map_read_foundry,
     .takes = SL_TAKES_LAYERS | SL_TAKES_DOORS | SL_TAKES_STARTS,
     .list = sli_map_list_foundry},
    {.name = "geojson",
     .endings = ".geojson .json",
     .what = "GeoJSON: rooms, walls, openings",
     .read = sli_map_read_geojson,
     .takes = SL_TAKES_LAYERS | SL_TAKES_DOORS | SL_TAKES_DEGREES | SL_TAKES_PLANS,
     .list = sli_map_list_geojson,
     .knows = knows_geojson},
    {.name = "wad",
     .endings = ".wad",
     .what = "a Doom WAD, classic, Hexen's or UDMF",
     .read = sli_map_read_wad,
     .takes = SL_TAKES_DOORS | SL_TAKES_CELLS | SL_TAKES_SECTORS,
     .list = sli_map_list_wad,
     .knows = knows_wad},
};

static const sl_export_format export_formats[] = {
    {.name = "png",
     .what = "the matrix of pairs as a picture, black where row sees column",
     .shows_mirrors = true,
     .write = sli_export_png},
    {.name = "reject",
     .what = "a copy of a Doom WAD with a new REJECT for the map; needs --wad and --map",
     .takes = SL_EXPORT_TAKES_WAD,
     .write = sli_export_reject},
};

sl_status sl_io_use(sl_context *context) {
    const sl_status status =
        sl_map_formats_add(context, map_formats, sizeof map_formats / sizeof *map_formats);
    if (status != SL_OK) return status;
    return sl_export_formats_add(context, export_formats,
                                 sizeof export_formats / sizeof *export_formats);
}
