/// Files of pictures: PNG by libpng, and portable bit, grey and colour maps (Netpbm), which are a
/// header and numbers. A colour counts as the mean of its three channels, as ROS' map_server has
/// it.
#include "io/image/image.h"

#include "io/parts/limits.h"
#include "sightline/support.h"

#include <inttypes.h>
#include <png.h>
#include <string.h>

void sl_image_destroy(sl_context *context, sl_image *image) {
    sl_free(context, image->pixels);
    *image = (sl_image){0};
}

static const char signature[] = "\x89PNG\r\n\x1a\n";

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

sl_status sli_image_read_alpha(sl_context *context, const char *name, const char *bytes,
                               size_t size, unsigned char **out) {
    png_image png = {.version = PNG_IMAGE_VERSION};
    *out = NULL;
    if (size < 8 || memcmp(bytes, signature, 8) != 0) return SL_OK;
    if (!png_image_begin_read_from_memory(&png, bytes, size))
        return sl_fail_at(context, name, 0, "PNG: %s", png.message);
    if (!(png.format & PNG_FORMAT_FLAG_ALPHA)) {
        png_image_free(&png);
        return SL_OK;
    }
    png.format = PNG_FORMAT_GA;
    const size_t pixels = (size_t)png.width * png.height;
    unsigned char *read = sl_alloc_array(context, pixels, 2);
    sl_status status = read ? SL_OK : SL_NO_MEMORY;
    if (read && !png_image_finish_read(&png, NULL, read, 0, NULL))
        status = sl_fail_at(context, name, 0, "PNG: %s", png.message);
    png_image_free(&png);
    for (size_t i = 0; status == SL_OK && i < pixels && !*out; i++)
        if (read[2 * i + 1] < 128) *out = read;
    if (!*out) sl_free(context, read);
    return status;
}

// --- portable maps

typedef struct portable {
    sl_context *context;
    const char *name;
    const char *at, *end;
    uint32_t line;
} portable;

enum { MOST_NUMBER = 1 << 24 };

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
    while (file->at < file->end && *file->at >= '0' && *file->at <= '9' && *value <= MOST_NUMBER &&
           !(digit && file->at > first))
        *value = 10 * *value + (unsigned)(*file->at++ - '0');
    if (*value > MOST_NUMBER)
        return sl_fail_at(file->context, file->name, file->line, "a number is too large: over %d",
                          MOST_NUMBER);
    if (file->at == first)
        return sl_fail_at(file->context, file->name, file->line, "expected a number, found %s",
                          file->at == file->end ? "the end of the file" : "something else");
    return SL_OK;
}

/// A channel of a pixel, from 0 to 255.
static unsigned to_byte(unsigned value, unsigned most) {
    return (value * 255u + most / 2) / most;
}

/// Channels in binary: a bit, a byte or two bytes each, rows of bits padded to bytes.
static sl_status read_binary(portable *file, bool bits, unsigned channels, unsigned most,
                             sl_image *image) {
    const size_t depth = most > 255 ? 2 : 1;
    const size_t row_bytes = bits ? (image->width + 7) / 8 : image->width * depth * channels;
    if (file->at < file->end) file->at++;
    if ((size_t)(file->end - file->at) / row_bytes < image->height)
        return sl_fail_at(file->context, file->name, 0,
                          "%zu x %zu pixels need %zu bytes; the file has %zu", image->width,
                          image->height, row_bytes * image->height, (size_t)(file->end - file->at));
    for (size_t y = 0; y < image->height; y++) {
        const unsigned char *row = (const unsigned char *)file->at + y * row_bytes;
        for (size_t x = 0; x < image->width; x++) {
            unsigned sum = 0;
            for (size_t i = channels * x; i < channels * (x + 1); i++) {
                unsigned value;
                if (bits)
                    value = row[i / 8] >> (7 - i % 8) & 1 ? 0 : most;
                else
                    value = depth == 1 ? row[i] : 256u * row[2 * i] + row[2 * i + 1];
                sum += to_byte(value > most ? most : value, most);
            }
            image->pixels[y * image->width + x] = (unsigned char)(sum / channels);
        }
    }
    return SL_OK;
}

static sl_status read_plain(portable *file, bool bits, unsigned channels, unsigned most,
                            sl_image *image) {
    for (size_t i = 0; i < image->width * image->height; i++) {
        unsigned sum = 0;
        for (unsigned k = 0; k < channels; k++) {
            unsigned value;
            SL_TRY(next_number(file, bits, &value));
            if (value > most)
                return sl_fail_at(file->context, file->name, file->line,
                                  "a pixel of %u: at most %u was announced", value, most);
            sum += to_byte(bits ? 1 - value : value, most);
        }
        image->pixels[i] = (unsigned char)(sum / channels);
        if (i % 65536 == 0) SL_TRY(sl_check_cancelled(file->context));
    }
    return SL_OK;
}

static sl_status read_portable(portable *file, sl_image *image) {
    const char kind = file->at[1];
    const bool bits = kind == '1' || kind == '4';
    const unsigned channels = kind == '3' || kind == '6' ? 3 : 1;
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
    return kind >= '4' ? read_binary(file, bits, channels, most, image)
                       : read_plain(file, bits, channels, most, image);
}

/// What a picture is that is not read; NULL for what is not known.
static const char *other_kind(const char *bytes, size_t size) {
    if (size >= 12 && !memcmp(bytes, "RIFF", 4) && !memcmp(bytes + 8, "WEBP", 4)) return "WebP";
    if (size >= 3 && !memcmp(bytes, "\xFF\xD8\xFF", 3)) return "JPEG";
    if (size >= 6 && !memcmp(bytes, "GIF8", 4)) return "GIF";
    return size >= 2 && !memcmp(bytes, "BM", 2) ? "BMP" : NULL;
}

static sl_status fail_kind(sl_context *context, const char *name, const char *bytes, size_t size) {
    const char *kind = other_kind(bytes, size);
    if (kind)
        return sl_fail_at(context, name, 0, "a %s picture, whatever its name says: save it as PNG",
                          kind);
    return sl_fail_at(context, name, 0,
                      "neither PNG nor a portable bit, grey or colour map (P1 to P6)");
}

sl_status sl_image_read(sl_context *context, const char *name, const char *bytes, size_t size,
                        sl_image *out) {
    sl_image image = {0};
    sl_status status;
    if (size >= 8 && memcmp(bytes, signature, 8) == 0) {
        status = read_png(context, name, bytes, size, &image);
    } else if (size >= 3 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6') {
        portable file = {context, name, bytes, bytes + size, 1};
        status = read_portable(&file, &image);
    } else {
        status = fail_kind(context, name, bytes, size);
    }
    if (status == SL_OK)
        *out = image;
    else
        sl_image_destroy(context, &image);
    return status;
}
