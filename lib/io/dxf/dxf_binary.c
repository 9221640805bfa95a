/// Binary drawings: the same groups and values as in a text, with numbers as a processor has them.
/// A value's kind follows from its group code (Autodesk, DXF Reference: binary DXF files). Codes
/// have two bytes since release 13; before, one, or three where the first is 255.
///
/// Such a drawing is written as the text that it would be, and that is read: numbers in the
/// shortest text that gives the same double. So a line that a message names is that of this text,
/// the one that other programs write when they save the drawing as ASCII DXF.
#include "io/dxf/dxf.h"

#include <inttypes.h>
#include <math.h>

static const char first_bytes[] = "AutoCAD Binary DXF\r\n\x1a"; // and the 0 behind

bool sli_dxf_is_binary(const char *bytes, size_t size) {
    return size >= sizeof first_bytes && memcmp(bytes, first_bytes, sizeof first_bytes) == 0;
}

typedef struct binary {
    sli_dxf *dxf;
    const unsigned char *at, *end;
    bool wide; ///< codes have two bytes
} binary;

/// A number of so many bytes, the lowest one first. The bytes are there.
static uint64_t take(binary *b, size_t bytes) {
    uint64_t value = 0;
    for (size_t i = 0; i < bytes; i++) value |= (uint64_t)*b->at++ << (8 * i);
    return value;
}

static size_t left(const binary *b) {
    return (size_t)(b->end - b->at);
}

typedef enum value_kind { TEXT, REAL, BYTES, BOOLEAN, SHORT, LONG, LONGER } value_kind;

static value_kind kind_of(unsigned code) {
    static const struct {
        unsigned first, last;
        value_kind kind;
    } kinds[] = {{10, 59, REAL},      {60, 79, SHORT},     {90, 99, LONG},    {110, 149, REAL},
                 {160, 169, LONGER},  {170, 179, SHORT},   {210, 239, REAL},  {270, 289, SHORT},
                 {290, 299, BOOLEAN}, {310, 319, BYTES},   {370, 389, SHORT}, {400, 409, SHORT},
                 {420, 429, LONG},    {440, 459, LONG},    {460, 469, REAL},  {1004, 1004, BYTES},
                 {1010, 1059, REAL},  {1060, 1070, SHORT}, {1071, 1071, LONG}};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (code >= kinds[i].first && code <= kinds[i].last) return kinds[i].kind;
    return TEXT;
}

static sl_status put(binary *b, const char *text, size_t length) {
    SL_TRY(SL_ARRAY_ROOM(b->dxf->context, &b->dxf->text, length + 1));
    char *to = b->dxf->text.items + b->dxf->text.count;
    // A line of the text is one value.
    for (size_t i = 0; i < length; i++) to[i] = (unsigned char)text[i] < ' ' ? ' ' : text[i];
    to[length] = '\n';
    b->dxf->text.count += length + 1;
    return SL_OK;
}

static sl_status put_number(binary *b, value_kind kind) {
    static const size_t bytes[] = {
        [REAL] = 8, [BOOLEAN] = 1, [SHORT] = 2, [LONG] = 4, [LONGER] = 8};
    char text[SL_NUMBER_TEXT] = "nan";
    const uint64_t bits = take(b, bytes[kind]);
    double real;
    memcpy(&real, &bits, sizeof real);
    if (kind == REAL && isfinite(real)) sl_number_write(real, text);
    if (kind == BOOLEAN) snprintf(text, sizeof text, "%u", (unsigned)bits);
    if (kind == SHORT) snprintf(text, sizeof text, "%d", (int)(int16_t)bits);
    if (kind == LONG) snprintf(text, sizeof text, "%" PRId32, (int32_t)bits);
    if (kind == LONGER) snprintf(text, sizeof text, "%" PRId64, (int64_t)bits);
    return put(b, text, strlen(text));
}

/// The bytes of a value, as far as they are there; 0 where they are not all.
static size_t value_bytes(const binary *b, value_kind kind) {
    static const size_t bytes[] = {
        [REAL] = 8, [BOOLEAN] = 1, [SHORT] = 2, [LONG] = 4, [LONGER] = 8};
    size_t needed = bytes[kind];
    if (kind == TEXT) {
        const unsigned char *end = left(b) ? memchr(b->at, 0, left(b)) : NULL;
        return end ? (size_t)(end - b->at) + 1 : 0;
    }
    if (kind == BYTES) needed = left(b) ? (size_t)*b->at + 1 : 1;
    return needed <= left(b) ? needed : 0;
}

static bool take_code(binary *b, unsigned *code) {
    if (left(b) < (b->wide ? 2u : 1u)) return false;
    *code = (unsigned)take(b, b->wide ? 2 : 1);
    if (b->wide || *code != 255) return true;
    if (left(b) < 2) return false;
    *code = (unsigned)take(b, 2);
    return true;
}

static sl_status put_pair(binary *b, unsigned code, bool *last) {
    char text[16];
    const value_kind kind = kind_of(code);
    const size_t bytes = value_bytes(b, kind);
    snprintf(text, sizeof text, "%u", code);
    if (!bytes)
        return sl_fail_at(b->dxf->context, b->dxf->name, 0,
                          "binary DXF: the file ends within the value of group %u", code);
    SL_TRY(put(b, text, strlen(text)));
    if (kind != TEXT && kind != BYTES) return put_number(b, kind);
    const char *value = (const char *)b->at;
    b->at += bytes;
    *last = code == 0 && strcmp(value, "EOF") == 0;
    // Nobody here reads values of bytes.
    return put(b, value, kind == TEXT ? bytes - 1 : 0);
}

sl_status sli_dxf_from_binary(sli_dxf *dxf, const char *bytes, size_t size) {
    const unsigned char *begin = (const unsigned char *)bytes + sizeof first_bytes;
    binary b = {dxf, begin, (const unsigned char *)bytes + size, false};
    // The first group is 0 or 999. A text of length 0 behind a code of one byte is none.
    b.wide = left(&b) >= 2 && (begin[1] == 0 || (begin[0] == 0xe7 && begin[1] == 3));
    unsigned code;
    bool last = false;
    for (size_t i = 1; !last && take_code(&b, &code); i++) {
        SL_TRY(put_pair(&b, code, &last));
        if (i % 4096 == 0) SL_TRY(sl_check_cancelled(dxf->context));
    }
    return SL_OK;
}
