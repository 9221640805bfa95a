/// Colours (CSS Color 4): #rgb, #rrggbb, with an opacity or without, rgb() and rgba() with numbers
/// or shares, and the names that drawings use.
#include "io/svg/svg_colour.h"

#include "base/base.h"

#include <math.h>
#include <string.h>
#include <strings.h>

static const struct {
    const char *name;
    uint32_t colour;
} names[] = {
    {"black", 0x000000},        {"white", 0xFFFFFF},         {"red", 0xFF0000},
    {"lime", 0x00FF00},         {"blue", 0x0000FF},          {"gray", 0x808080},
    {"grey", 0x808080},         {"darkgray", 0xA9A9A9},      {"darkgrey", 0xA9A9A9},
    {"lightgray", 0xD3D3D3},    {"lightgrey", 0xD3D3D3},     {"dimgray", 0x696969},
    {"dimgrey", 0x696969},      {"silver", 0xC0C0C0},        {"gainsboro", 0xDCDCDC},
    {"whitesmoke", 0xF5F5F5},   {"darkslategray", 0x2F4F4F}, {"slategray", 0x708090},
    {"green", 0x008000},        {"navy", 0x000080},          {"maroon", 0x800000},
    {"purple", 0x800080},       {"teal", 0x008080},          {"olive", 0x808000},
    {"yellow", 0xFFFF00},       {"orange", 0xFFA500},        {"brown", 0xA52A2A},
    {"pink", 0xFFC0CB},         {"beige", 0xF5F5DC},         {"tan", 0xD2B48C},
    {"lightblue", 0xADD8E6},    {"lightgreen", 0x90EE90},    {"lightyellow", 0xFFFFE0},
    {"skyblue", 0x87CEEB},      {"steelblue", 0x4682B4},     {"cyan", 0x00FFFF},
    {"aqua", 0x00FFFF},         {"magenta", 0xFF00FF},       {"fuchsia", 0xFF00FF},
    {"gold", 0xFFD700},         {"ivory", 0xFFFFF0},         {"none", 0xFFFFFF},
    {"currentcolor", 0x000000},
};

static int digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    c |= 0x20;
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/// The digits behind a '#': three, four, six or eight.
static uint32_t by_digits(const char *at, size_t count, double *opacity) {
    const bool brief = count < 6;
    uint32_t parts[4] = {0, 0, 0, 255};
    if (count != 3 && count != 4 && count != 6 && count != 8) return SLI_SVG_NO_COLOUR;
    for (size_t i = 0; i < count; i++) {
        const int one = digit(at[i]);
        if (one < 0) return SLI_SVG_NO_COLOUR;
        uint32_t *part = &parts[brief ? i : i / 2];
        *part = brief ? 17 * (uint32_t)one : i % 2 ? *part * 16 + (uint32_t)one : (uint32_t)one;
    }
    *opacity = parts[3] / 255.0;
    return parts[0] << 16 | parts[1] << 8 | parts[2];
}

/// "rgb(1, 2, 3)", "rgba(10% 20% 30% / 0.5)".
static uint32_t by_numbers(sli_word value, double *opacity) {
    const char *at = memchr(value.at, '(', value.length), *const end = value.at + value.length;
    uint32_t colour = 0;
    for (int i = 0; i < 4; i++) {
        for (at++; at < end && strchr(" \t\r\n,/", *at);) at++;
        double number = 0;
        const size_t length = at < end ? sli_number_length(at, (size_t)(end - at)) : 0;
        if (!length && i == 3) return colour;
        if (!length || !sl_number_read(at, length, &number)) return SLI_SVG_NO_COLOUR;
        at += length;
        const bool share = at < end && *at == '%';
        if (i == 3) *opacity = fmin(1, fmax(0, share ? number / 100 : number));
        if (i < 3)
            colour =
                colour << 8 | (uint32_t)lround(fmin(255, fmax(0, share ? 2.55 * number : number)));
        if (!share) at--;
    }
    return colour;
}

uint32_t sli_svg_colour(sli_word value, double *opacity) {
    *opacity = 1;
    if (value.length && *value.at == '#') return by_digits(value.at + 1, value.length - 1, opacity);
    if (value.length > 4 && strncasecmp(value.at, "rgb", 3) == 0 &&
        memchr(value.at, '(', value.length))
        return by_numbers(value, opacity);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strlen(names[i].name) == value.length &&
            strncasecmp(value.at, names[i].name, value.length) == 0)
            return names[i].colour;
    return SLI_SVG_NO_COLOUR;
}

/// A colour as it is seen on white.
static uint32_t on_white(uint32_t colour, double opacity) {
    uint32_t seen = 0;
    for (int shift = 16; shift >= 0; shift -= 8) {
        const double part = colour >> shift & 0xFF;
        seen = seen << 8 | (uint32_t)lround(255 + opacity * (part - 255));
    }
    return seen;
}

sli_ink sli_svg_ink(const sli_svg_paint *paint, double scale) {
    const bool line = paint->stroke && !paint->clear_stroke && !paint->thin;
    const bool filled = !paint->no_fill && !paint->clear_fill;
    const bool same = filled && paint->fill == paint->line;
    const uint32_t colour = line ? paint->line : paint->fill;
    const double opacity = paint->opacity * (line ? paint->line_opacity : paint->fill_opacity);
    sli_ink ink = {.line = line && !same, .known = colour != SLI_SVG_NO_COLOUR};
    if (ink.known) ink.colour = on_white(colour, opacity);
    if (ink.line) ink.width = (paint->width > 0 ? paint->width : 1) * scale;
    return ink;
}
