/// The map.yaml of ROS' map_server, which names a picture, the size of its pixels, where it lies,
/// and from which occupancy a pixel is an obstacle, and up to which it is free.
#include "io/image/image.h"
#include "io/io_formats.h"
#include "io/parts/names.h"
#include "io/parts/shapes.h"
#include "map/scan.h"
#include "sightline/support.h"

#include <math.h>
#include <string.h>
#include <yaml.h>

/// The usual thresholds, which older loaders had where a file has none.
#define FREE     0.196
#define OCCUPIED 0.65
/// Less than any darkness but none.
#define LEAST (0.5 / 255)

typedef struct ros_map {
    sl_context *context;
    const char *name;
    char *image; ///< as written; NULL until it is met
    double resolution, free, occupied;
    double origin[3];
    double negate;
    unsigned origin_count;
    bool scale;
    uint32_t image_line, origin_line;
} ros_map;

typedef struct ros_value {
    char text[512];
    uint32_t line;
} ros_value;

static sl_status fail_yaml(const ros_map *m, const yaml_parser_t *parser) {
    return sl_fail_at(m->context, m->name, (unsigned)parser->problem_mark.line + 1, "YAML: %s",
                      parser->problem ? parser->problem : "not well formed");
}

static sl_status read_number(const ros_map *m, const char *key, const ros_value *value,
                             double *out) {
    const sli_word word = {value->text, strlen(value->text)};
    double number;
    if (!sl_number_read(word.at, word.length, &number) ||
        !sl_coordinate_usable(sli_coordinate(number)))
        return sl_fail_at(m->context, m->name, value->line, "%s: expected a number, found '%s'",
                          key, sli_show(word).text);
    *out = sli_coordinate(number);
    return SL_OK;
}

static sl_status read_threshold(const ros_map *m, const char *key, const ros_value *value,
                                double *out) {
    SL_TRY(read_number(m, key, value, out));
    if (*out >= 0 && *out <= 1) return SL_OK;
    return sl_fail_at(m->context, m->name, value->line,
                      "%s: expected a number from 0 to 1, found '%s'", key,
                      sli_show((sli_word){value->text, strlen(value->text)}).text);
}

static sl_status fail_origin(const ros_map *m) {
    return sl_fail_at(m->context, m->name, m->origin_line, "origin: expected [x, y, yaw]");
}

/// A value that is one word; keys that are not asked for are passed over.
static sl_status take_value(ros_map *m, const char *key, const ros_value *value) {
    if (strcmp(key, "image") == 0) {
        sl_free(m->context, m->image);
        m->image = sl_copy_text(m->context, value->text, strlen(value->text));
        m->image_line = value->line;
        return m->image ? SL_OK : SL_NO_MEMORY;
    }
    if (strcmp(key, "resolution") == 0) return read_number(m, key, value, &m->resolution);
    if (strcmp(key, "free_thresh") == 0) return read_threshold(m, key, value, &m->free);
    if (strcmp(key, "occupied_thresh") == 0) return read_threshold(m, key, value, &m->occupied);
    if (strcmp(key, "origin") == 0) {
        m->origin_line = value->line;
        return fail_origin(m);
    }
    if (strcmp(key, "mode") == 0) {
        m->scale = strcmp(value->text, "scale") == 0;
        if (m->scale || strcmp(value->text, "trinary") == 0) return SL_OK;
        return sl_fail_at(m->context, m->name, value->line,
                          "mode: only trinary and scale are known here");
    }
    if (strcmp(key, "negate") != 0) return SL_OK;
    const bool on = strcmp(value->text, "true") == 0, off = strcmp(value->text, "false") == 0;
    m->negate = on;
    return on || off ? SL_OK : read_number(m, key, value, &m->negate);
}

static sl_status take_item(ros_map *m, const char *key, const ros_value *value) {
    if (strcmp(key, "origin") != 0) return SL_OK;
    if (m->origin_count == 3)
        return sl_fail_at(m->context, m->name, value->line, "origin: more than x, y and yaw");
    return read_number(m, key, value, &m->origin[m->origin_count++]);
}

/// Reads a mapping of words to words or to lists of words.
static sl_status read_events(ros_map *m, yaml_parser_t *parser) {
    char key[64] = "";
    bool has_key = false;
    unsigned maps = 0, lists = 0;
    for (;;) {
        yaml_event_t event;
        if (!yaml_parser_parse(parser, &event)) return fail_yaml(m, parser);
        const yaml_event_type_t type = event.type;
        ros_value value = {.line = (uint32_t)event.start_mark.line + 1};
        if (type == YAML_SCALAR_EVENT)
            snprintf(value.text, sizeof value.text, "%s", (const char *)event.data.scalar.value);
        yaml_event_delete(&event);
        maps += type == YAML_MAPPING_START_EVENT;
        lists += type == YAML_SEQUENCE_START_EVENT;
        lists -= type == YAML_SEQUENCE_END_EVENT;
        if (type == YAML_STREAM_END_EVENT) return SL_OK;
        if (maps > 1 || lists > 1 || type == YAML_ALIAS_EVENT || (lists && !has_key))
            return sl_fail_at(m->context, m->name, value.line,
                              "expected 'key: value' or 'key: [values]', as in a map.yaml of ROS");
        if (type == YAML_SEQUENCE_START_EVENT && strcmp(key, "origin") == 0)
            m->origin_line = value.line;
        if (type == YAML_SEQUENCE_END_EVENT) has_key = false;
        if (type != YAML_SCALAR_EVENT) continue;
        if (!has_key) {
            // Longer than any key that is asked for: cut, it is none of them.
            snprintf(key, sizeof key, "%.63s", value.text);
            has_key = true;
        } else if (lists) {
            SL_TRY(take_item(m, key, &value));
        } else {
            SL_TRY(take_value(m, key, &value));
            has_key = false;
        }
    }
}

static sl_status read_yaml(ros_map *m, const char *text, size_t size) {
    yaml_parser_t parser;
    if (!yaml_parser_initialize(&parser)) return sl_fail_memory(m->context);
    yaml_parser_set_input_string(&parser, (const unsigned char *)text, size);
    const sl_status status = read_events(m, &parser);
    yaml_parser_delete(&parser);
    SL_TRY(status);
    if (!m->image) return sl_fail_at(m->context, m->name, 0, "no 'image' is named");
    if (!(m->resolution > 0))
        return sl_fail_at(m->context, m->name, 0, "'resolution' is missing or not positive");
    if (m->origin_line && m->origin_count != 3) return fail_origin(m);
    if (!(fabs(m->origin[2]) <= 1e3))
        return sl_fail_at(m->context, m->name, m->origin_line,
                          "origin: the yaw is no angle in radians");
    return SL_OK;
}

/// A free_thresh of 0 takes no pixel as free: some tools write it for a value that they do not
/// know.
static void settle_thresholds(ros_map *m) {
    if (m->free > 0) return;
    const bool both = m->occupied <= 0;
    m->free = FREE;
    if (both) m->occupied = OCCUPIED;
    sl_note(m->context,
            "%s: free_thresh 0 leaves no free ground, so it cannot be meant: free_thresh %g%s, as "
            "is usual; --threshold T takes others",
            m->name, m->free, both ? " and occupied_thresh 0.65 are taken" : " is taken");
}

/// The picture as named or, since maps are often renamed, one that has the map's own name.
static sl_status find_image(const ros_map *m, char **path) {
    *path = sli_beside_path(m->context, m->name, (sli_word){m->image, strlen(m->image)});
    if (!*path) return SL_NO_MEMORY;
    if (sli_beside_is_there(*path)) return SL_OK;
    sl_free(m->context, *path);
    const char *dot = strrchr(m->name, '.');
    const size_t stem = dot ? (size_t)(dot - m->name) : strlen(m->name);
    *path = sl_alloc(m->context, stem + 5);
    if (!*path) return SL_NO_MEMORY;
    memcpy(*path, m->name, stem);
    static const char *const endings[] = {".pgm", ".png"};
    for (int i = 0; i < 2; i++) {
        memcpy(*path + stem, endings[i], 5);
        if (!sli_beside_is_there(*path)) continue;
        sl_note(m->context, "%s: there is no picture '%s' beside it; '%s' is taken", m->name,
                m->image, *path);
        return SL_OK;
    }
    sl_free(m->context, *path);
    *path = NULL;
    return sl_fail_at(m->context, m->name, m->image_line, "image: there is no picture '%s'",
                      sli_show((sli_word){m->image, strlen(m->image)}).text);
}

static sl_status read_image(const ros_map *m, sl_image *image) {
    char *path;
    sl_bytes bytes;
    SL_TRY(find_image(m, &path));
    sl_status status = sl_file_read(m->context, path, &bytes);
    if (status == SL_OK) {
        status = sl_image_read(m->context, path, bytes.data, bytes.size, image);
        sl_free(m->context, bytes.data);
    }
    sl_free(m->context, path);
    return status;
}

/// Turns walls about the origin by the yaw. Files round it: what is a millionth off a quarter turn
/// is meant to be one, and then walls stay upright and level.
static void turn(const ros_map *m, sl_map *map) {
    const double quarters = m->origin[2] / 1.5707963267948966, whole = round(quarters);
    const double degrees = 90 * (fabs(quarters - whole) <= 1e-6 ? whole : quarters);
    const sli_affine back = {.xx = 1, .x0 = -m->origin[0], .yy = 1, .y0 = -m->origin[1]};
    sli_affine turned = sli_affine_after(sli_affine_turn(degrees), back);
    turned.x0 += m->origin[0];
    turned.y0 += m->origin[1];
    for (size_t i = 0; m->origin[2] != 0 && i < map->wall_count; i++) {
        map->walls[i].a = sli_affine_apply(turned, map->walls[i].a);
        map->walls[i].b = sli_affine_apply(turned, map->walls[i].b);
    }
}

/// Whether some pixel is neither free nor occupied.
static bool has_unknown(const ros_map *m, const sl_image *image) {
    for (size_t i = 0; i < image->width * image->height; i++) {
        const int value = m->negate != 0 ? image->pixels[i] : 255 - image->pixels[i];
        if (value >= m->free * 255 && value <= m->occupied * 255) return true;
    }
    return false;
}

/// Map savers write lightness 254 for free and 205 for unknown ground, and older loaders knew the
/// latter by a free_thresh of 0.196. Newer savers write 0.25 beside it, by which it is free. Where
/// no other lightness is free, a saver wrote the picture, and unknown ground is solid.
static void settle_grey(ros_map *m, const sl_image *image) {
    enum { FREE_GROUND = 1, UNKNOWN = 50 }; // of 255, as occupancy
    size_t grey = 0, others = 0, open = 0;
    const size_t all = image->width * image->height;
    if (m->free * 255 <= UNKNOWN || m->free > m->occupied || m->scale || m->negate != 0) return;
    for (size_t i = 0; i < all; i++) {
        const int value = 255 - image->pixels[i];
        grey += value == UNKNOWN;
        open += value <= FREE_GROUND;
        others += value > FREE_GROUND && value != UNKNOWN && value < m->free * 255;
    }
    if (!grey || open + others == 0 || (others && grey < all / 50 + 1)) return;
    const double percent = 100.0 * (double)grey / (double)all;
    if (others) {
        sl_note(m->context,
                "%s: %.0f %% of the picture has the grey that map savers write for unknown ground; "
                "free_thresh %g takes it as free; if it is unknown, --threshold 0.19 makes it "
                "solid",
                m->name, percent, m->free);
        return;
    }
    sl_note(m->context,
            "%s: %.3g %% of the picture has the grey that map savers write for unknown ground: it "
            "is solid, though free_thresh %g takes it as free; --threshold %g does so here",
            m->name, percent, m->free, m->free);
    m->free = FREE;
}

static void note_taken(const ros_map *m, const sl_image *image, const sli_image_plan *plan,
                       size_t solid, size_t walls, bool given) {
    char unknown[100] = "";
    if (!given && has_unknown(m, image))
        snprintf(unknown, sizeof unknown, "; %s ground is solid: --threshold %g takes it as free",
                 m->scale ? "partly occupied" : "unknown", m->occupied);
    sl_note(m->context,
            "%s: %zu of %zu x %zu pixels of %g m are solid (occupancy from %g); %zu wall%s%s",
            m->name, solid, image->width, image->height, plan->step, plan->threshold, walls,
            walls == 1 ? "" : "s", unknown);
}

static void note_no_walls(const ros_map *m, const sl_image *image, size_t solid) {
    sl_note(m->context,
            "%s: it has no walls, as %s: --threshold T, from 0 to 1, takes what is darker than T "
            "as solid",
            m->name,
            solid == image->width * image->height ? "all pixels are solid" : "no pixel is solid");
}

static sl_status read_map(ros_map *m, const sl_import_options *options, const char *text,
                          size_t size, sl_map *map) {
    sl_image image = {0};
    size_t solid;
    SL_TRY(sli_refuse_nul(m->context, m->name, text, size));
    SL_TRY(read_yaml(m, text, size));
    SL_TRY(read_image(m, &image));
    const bool given = options->threshold > 0;
    if (!given) {
        settle_thresholds(m);
        settle_grey(m, &image);
    }
    // What is occupied is no free ground, whatever free_thresh says: as map_server reads it.
    const double least = fmax(fmin(m->free, m->occupied), LEAST);
    const sli_image_plan plan = {.threshold = given ? options->threshold : least,
                                 .light = m->negate != 0,
                                 .solid_outside = !given,
                                 .step = m->resolution,
                                 .origin = {m->origin[0], m->origin[1]}};
    const sl_status status = sli_image_add_walls(m->context, &image, &plan, map, &solid, NULL);
    strcpy(map->unit, "m");
    if (status == SL_OK) turn(m, map);
    if (status == SL_OK) note_taken(m, &image, &plan, solid, map->wall_count, given);
    if (status == SL_OK && !map->wall_count) note_no_walls(m, &image, solid);
    sl_image_destroy(m->context, &image);
    return status;
}

sl_status sli_map_read_ros(sl_context *context, const char *name, const char *text, size_t size,
                           const sl_import_options *options, sl_map *map) {
    sl_map read = {0};
    ros_map m = {.context = context, .name = name, .free = FREE, .occupied = OCCUPIED};
    const sl_status status = read_map(&m, options, text, size, &read);
    sl_free(context, m.image);
    if (status == SL_OK)
        *map = read;
    else
        sl_map_destroy(context, &read);
    return status;
}
