/// Pictures as plans: PNG by libpng, portable grey and bit maps (Netpbm), which are a header and
/// numbers, and the map.yaml of ROS' map_server, which names a picture, the size of its pixels,
/// where it lies, and from which occupancy a pixel is an obstacle. Walls run along the edges
/// between solid pixels and others.
#include "io/io_formats.h"
#include "io/parts/limits.h"
#include "io/parts/names.h"
#include "io/parts/shapes.h"
#include "map/grid.h"
#include "map/scan.h"
#include "map/source.h"
#include "sightline/io.h"
#include "sightline/support.h"

#include <inttypes.h>
#include <math.h>
#include <png.h>
#include <string.h>
#include <yaml.h>

void sl_image_destroy(sl_context *context, sl_image *image) {
    sl_free(context, image->pixels);
    *image = (sl_image){0};
}

static sl_status make_room(sl_context *context, const char *name, size_t width, size_t height,
                           sl_image *image) {
    char what[64];
    if (width == 0 || height == 0) return sl_fail_at(context, name, 0, "a picture without pixels");
    snprintf(what, sizeof what, "a picture of %zu x %zu", width, height);
    SL_TRY(sli_limit_check(context, name, 0, SLI_LIMIT_PIXELS, sli_limit_product(width, height),
                           what));
    image->pixels = sl_alloc(context, width * height);
    if (!image->pixels) return SL_NO_MEMORY;
    image->width = width;
    image->height = height;
    return SL_OK;
}

static sl_status read_png(sl_context *context, const char *name, const char *bytes, size_t size,
                          sl_image *image) {
    static const png_color white = {255, 255, 255};
    png_image png = {.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_memory(&png, bytes, size))
        return sl_fail_at(context, name, 0, "PNG: %s", png.message);
    png.format = PNG_FORMAT_GRAY;
    sl_status status = make_room(context, name, png.width, png.height, image);
    if (status == SL_OK &&
        (!png_image_finish_read(&png, &white, image->pixels, 0, NULL) || PNG_IMAGE_FAILED(png)))
        status = sl_fail_at(context, name, 0, "PNG: %s", png.message);
    png_image_free(&png);
    return status;
}

// --- portable maps

typedef struct portable {
    sl_context *context;
    const char *name;
    const char *at, *end;
    uint32_t line;
} portable;

/// The next number of the header or of a plain map; comments run from '#' to the line's end. In a
/// plain bit map digits may stand without blank between them.
static sl_status next_number(portable *file, bool digit, unsigned *value) {
    bool comment = false;
    for (; file->at < file->end; file->at++) {
        if (*file->at == '#') comment = true;
        if (*file->at == '\n') comment = false, file->line++;
        if (!comment && !strchr(" \t\r\n\f\v", *file->at)) break;
    }
    const char *first = file->at;
    *value = 0;
    while (file->at < file->end && *file->at >= '0' && *file->at <= '9' && *value < 1u << 24 &&
           !(digit && file->at > first))
        *value = 10 * *value + (unsigned)(*file->at++ - '0');
    if (file->at == first)
        return sl_fail_at(file->context, file->name, file->line, "expected a number, found %s",
                          file->at == file->end ? "the end of the file" : "something else");
    return SL_OK;
}

/// Pixels in binary: a bit, a byte or two bytes each, rows of bits padded to bytes.
static sl_status read_binary(portable *file, bool bits, unsigned most, sl_image *image) {
    const size_t depth = most > 255 ? 2 : 1;
    const size_t row_bytes = bits ? (image->width + 7) / 8 : image->width * depth;
    if (file->at < file->end) file->at++;
    if ((size_t)(file->end - file->at) / row_bytes < image->height)
        return sl_fail_at(file->context, file->name, 0,
                          "%zu x %zu pixels need %zu bytes; the file has %zu", image->width,
                          image->height, row_bytes * image->height, (size_t)(file->end - file->at));
    for (size_t y = 0; y < image->height; y++) {
        const unsigned char *row = (const unsigned char *)file->at + y * row_bytes;
        for (size_t x = 0; x < image->width; x++) {
            unsigned value;
            if (bits)
                value = row[x / 8] >> (7 - x % 8) & 1 ? 0 : most;
            else
                value = depth == 1 ? row[x] : 256u * row[2 * x] + row[2 * x + 1];
            if (value > most) value = most;
            image->pixels[y * image->width + x] = (unsigned char)((value * 255u + most / 2) / most);
        }
    }
    return SL_OK;
}

static sl_status read_plain(portable *file, bool bits, unsigned most, sl_image *image) {
    for (size_t i = 0; i < image->width * image->height; i++) {
        unsigned value;
        SL_TRY(next_number(file, bits, &value));
        if (value > most)
            return sl_fail_at(file->context, file->name, file->line,
                              "a pixel of %u: at most %u was announced", value, most);
        if (bits) value = 1 - value;
        image->pixels[i] = (unsigned char)((value * 255u + most / 2) / most);
        if (i % 65536 == 0) SL_TRY(sl_check_cancelled(file->context));
    }
    return SL_OK;
}

static sl_status read_portable(portable *file, sl_image *image) {
    const char kind = file->at[1];
    const bool bits = kind == '1' || kind == '4';
    unsigned width, height, most = 1;
    file->at += 2;
    SL_TRY(next_number(file, false, &width));
    SL_TRY(next_number(file, false, &height));
    if (!bits) SL_TRY(next_number(file, false, &most));
    if (most == 0 || most > 65535)
        return sl_fail_at(file->context, file->name, file->line,
                          "the largest value is %u: expected 1 to 65535", most);
    // A bit, or a digit, is the least that a pixel takes: a short file has no place for many.
    const uint64_t least = (uint64_t)(width / 8) * height, left = (uint64_t)(file->end - file->at);
    if (least > left)
        return sl_fail_at(file->context, file->name, 0,
                          "%u x %u pixels need at least %" PRIu64 " bytes; the file has %" PRIu64,
                          width, height, least, left);
    SL_TRY(make_room(file->context, file->name, width, height, image));
    return kind >= '4' ? read_binary(file, bits, most, image) : read_plain(file, bits, most, image);
}

sl_status sl_image_read(sl_context *context, const char *name, const char *bytes, size_t size,
                        sl_image *out) {
    sl_image image = {0};
    sl_status status;
    if (size >= 8 && memcmp(bytes, "\x89PNG\r\n\x1a\n", 8) == 0) {
        status = read_png(context, name, bytes, size, &image);
    } else if (size >= 3 && bytes[0] == 'P' && bytes[1] && strchr("1245", bytes[1])) {
        portable file = {context, name, bytes, bytes + size, 1};
        status = read_portable(&file, &image);
    } else {
        status = sl_fail_at(context, name, 0,
                            "neither PNG nor a portable grey or bit map (P1, P2, P4, P5)");
    }
    if (status == SL_OK)
        *out = image;
    else
        sl_image_destroy(context, &image);
    return status;
}

// --- walls

/// How a picture is a plan.
typedef struct image_plan {
    double threshold;   ///< a pixel is solid where its darkness, 0 .. 1, is at least this
    bool light;         ///< the light pixels are the dark ones
    bool solid_outside; ///< beyond the picture all is solid; else it is open
    double step;        ///< the size of a pixel
    sl_point origin;    ///< of the lower left pixel's lower left corner
} image_plan;

/// Adds walls along the edges between solid and other pixels, merged. Gives the number of solid
/// pixels.
static sl_status image_add_walls(sl_context *context, const sl_image *image, const image_plan *plan,
                                 sl_map *map, size_t *solid) {
    sli_grid grid;
    SL_TRY(sli_grid_create(context, image->width, image->height, &grid));
    grid.origin = plan->origin;
    grid.step = (sl_point){plan->step, plan->step};
    grid.open_outside = !plan->solid_outside;
    grid.sure = true;
    *solid = 0;
    for (size_t i = 0; i < image->width * image->height; i++) {
        const int value = plan->light ? image->pixels[i] : 255 - image->pixels[i];
        if (value < plan->threshold * 255) continue;
        grid.squares[i] = '#';
        ++*solid;
    }
    const sl_status status = sli_grid_add_walls(context, &grid, map);
    sli_grid_destroy(context, &grid);
    return status;
}

sl_status sli_map_read_image(sl_context *context, const char *name, const char *text, size_t size,
                             const sl_import_options *options, sl_map *map) {
    sl_image image = {0};
    sl_map read = {0};
    size_t solid;
    const image_plan plan = {.threshold = options->threshold > 0 ? options->threshold : 0.5,
                             .step = 1};
    SL_TRY(sl_image_read(context, name, text, size, &image));
    const sl_status status = image_add_walls(context, &image, &plan, &read, &solid);
    if (status == SL_OK) {
        sl_note(context, "%s: %zu of %zu x %zu pixels are solid (darkness from %g); %zu walls",
                name, solid, image.width, image.height, plan.threshold, read.wall_count);
        strcpy(read.unit, "px");
        read.source.transform = sli_y_down((double)image.height, 1);
        *map = read;
    } else {
        sl_map_destroy(context, &read);
    }
    sl_image_destroy(context, &image);
    return status;
}

// --- maps of ROS

typedef struct ros_map {
    sl_context *context;
    const char *name;
    char *image; ///< as written; NULL until it is met
    double resolution, free;
    double origin[3];
    double negate;
    unsigned origin_count;
    bool raw;
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

/// A value that is one word; keys that are not asked for are passed over.
static sl_status take_value(ros_map *m, const char *key, const ros_value *value) {
    if (strcmp(key, "image") == 0) {
        sl_free(m->context, m->image);
        m->image = sl_copy_text(m->context, value->text, strlen(value->text));
        m->image_line = value->line;
        return m->image ? SL_OK : SL_NO_MEMORY;
    }
    if (strcmp(key, "resolution") == 0) return read_number(m, key, value, &m->resolution);
    if (strcmp(key, "free_thresh") == 0) return read_number(m, key, value, &m->free);
    if (strcmp(key, "mode") == 0) m->raw = strcmp(value->text, "raw") == 0;
    if (strcmp(key, "negate") != 0) return SL_OK;
    const bool on = strcmp(value->text, "true") == 0, off = strcmp(value->text, "false") == 0;
    m->negate = on;
    return on || off ? SL_OK : read_number(m, key, value, &m->negate);
}

static sl_status take_item(ros_map *m, const char *key, const ros_value *value) {
    if (strcmp(key, "origin") != 0) return SL_OK;
    m->origin_line = value->line;
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
    if (!(fabs(m->origin[2]) <= 1e3))
        return sl_fail_at(m->context, m->name, m->origin_line,
                          "origin: the yaw is no angle in radians");
    if (m->raw)
        return sl_fail_at(m->context, m->name, 0, "mode: only trinary and scale are known here");
    return SL_OK;
}

/// The picture as named or, since maps are often renamed, one that has the map's own name.
static sl_status find_image(const ros_map *m, char **path) {
    *path = sli_beside_path(m->context, m->name, m->image);
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

static sl_status read_map(ros_map *m, const sl_import_options *options, const char *text,
                          size_t size, sl_map *map) {
    sl_image image = {0};
    size_t solid;
    SL_TRY(sli_refuse_nul(m->context, m->name, text, size));
    SL_TRY(read_yaml(m, text, size));
    SL_TRY(read_image(m, &image));
    const bool given = options->threshold > 0;
    const image_plan plan = {.threshold = given ? options->threshold : m->free,
                             .light = m->negate != 0,
                             .solid_outside = !given,
                             .step = m->resolution,
                             .origin = {m->origin[0], m->origin[1]}};
    const sl_status status = image_add_walls(m->context, &image, &plan, map, &solid);
    strcpy(map->unit, "m");
    if (status == SL_OK) turn(m, map);
    if (status == SL_OK)
        sl_note(m->context,
                "%s: %zu of %zu x %zu pixels of %g m are solid (occupancy from %g); %zu walls%s",
                m->name, solid, image.width, image.height, plan.step, plan.threshold,
                map->wall_count,
                given ? "" : "; unknown ground is solid: --threshold 0.65 takes it as free");
    sl_image_destroy(m->context, &image);
    return status;
}

sl_status sli_map_read_ros(sl_context *context, const char *name, const char *text, size_t size,
                           const sl_import_options *options, sl_map *map) {
    sl_map read = {0};
    ros_map m = {.context = context, .name = name, .free = 0.196};
    const sl_status status = read_map(&m, options, text, size, &read);
    sl_free(context, m.image);
    if (status == SL_OK)
        *map = read;
    else
        sl_map_destroy(context, &read);
    return status;
}
