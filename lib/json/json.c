/// Writing JSON (RFC 8259). The writer knows how deep it is and whether an item stands before the
/// next one; from these two follow all commas, line ends and blanks.
#include "sightline/json.h"

#include <math.h>
#include <string.h>

static void put_to_stream(void *stream, const char *text, size_t size) {
    fwrite(text, 1, size, stream);
}

sl_json_writer sl_json_writer_to(FILE *stream, unsigned indent) {
    return (sl_json_writer){.put = put_to_stream, .user = stream, .indent = indent};
}

static void put(sl_json_writer *json, const char *text, size_t size) {
    json->put(json->user, text, size);
}

static void put_line_end(sl_json_writer *json) {
    static const char blanks[] = "                                ";
    if (!json->indent) return;
    put(json, "\n", 1);
    for (size_t left = (size_t)json->indent * json->depth; left;) {
        const size_t part = left < sizeof blanks ? left : sizeof blanks - 1;
        put(json, blanks, part);
        left -= part;
    }
}

/// What stands between an item and the one before it.
static void begin_item(sl_json_writer *json) {
    if (!json->keyed && json->depth) {
        if (json->follows) put(json, ",", 1);
        put_line_end(json);
    }
    json->keyed = false;
    json->follows = true;
}

static void put_scalar(sl_json_writer *json, const char *text, size_t size) {
    begin_item(json);
    put(json, text, size);
}

static void open(sl_json_writer *json, char bracket) {
    put_scalar(json, &bracket, 1);
    json->depth++;
    json->follows = false;
}

void sl_json_put_object(sl_json_writer *json) {
    open(json, '{');
}

void sl_json_put_list(sl_json_writer *json) {
    open(json, '[');
}

void sl_json_put_end(sl_json_writer *json, char bracket) {
    json->depth--;
    if (json->follows) put_line_end(json);
    put(json, &bracket, 1);
    json->follows = true;
}

static void put_colon(sl_json_writer *json) {
    put(json, ": ", json->indent ? 2 : 1);
    json->keyed = true;
}

static void put_escaped(sl_json_writer *json, unsigned char byte) {
    static const char letters[] = "\"\"\\\\\bb\ff\nn\rr\tt";
    char text[8];
    for (const char *at = letters; *at; at += 2)
        if ((unsigned char)*at == byte) {
            const char pair[2] = {'\\', at[1]};
            put(json, pair, 2);
            return;
        }
    put(json, text, (size_t)snprintf(text, sizeof text, "\\u%04X", byte));
}

static void put_quoted(sl_json_writer *json, const char *text) {
    put(json, "\"", 1);
    const char *from = text;
    for (; *text; text++) {
        const unsigned char byte = (unsigned char)*text;
        if (byte >= 0x20 && byte != '"' && byte != '\\') continue;
        put(json, from, (size_t)(text - from));
        put_escaped(json, byte);
        from = text + 1;
    }
    put(json, from, (size_t)(text - from));
    put(json, "\"", 1);
}

void sl_json_put_key(sl_json_writer *json, const char *key) {
    begin_item(json);
    put_quoted(json, key);
    put_colon(json);
}

void sl_json_put_null(sl_json_writer *json) {
    put_scalar(json, "null", 4);
}

void sl_json_put_flag(sl_json_writer *json, bool flag) {
    put_scalar(json, flag ? "true" : "false", flag ? 4 : 5);
}

void sl_json_put_integer(sl_json_writer *json, int64_t number) {
    char text[32];
    put_scalar(json, text, (size_t)snprintf(text, sizeof text, "%lld", (long long)number));
}

/// printf's exponent without its '+' and leading zeros: 1e+05 is 1e5.
static void shorten_exponent(char *text) {
    char *to = strchr(text, 'e');
    if (!to) return;
    const char *from = ++to;
    if (*from == '-') to++;
    for (from++; *from == '0' && from[1];) from++;
    memmove(to, from, strlen(from) + 1);
}

void sl_json_put_real(sl_json_writer *json, double finite) {
    char text[40];
    if (!isfinite(finite)) {
        json->failed = true;
        sl_json_put_null(json);
        return;
    }
    snprintf(text, sizeof text - 2, "%.17g", finite);
    bool whole = true;
    char *to = text;
    for (const char *at = text; *at; at++) {
        if (*at == 'e') whole = false;
        if (strchr("0123456789+-e", *at)) {
            *to++ = *at;
        } else if (whole) { // the locale's decimal point, of whatever bytes
            *to++ = '.';
            whole = false;
        }
    }
    *to = '\0';
    if (whole) strcat(text, ".0");
    shorten_exponent(text);
    put_scalar(json, text, strlen(text));
}

void sl_json_put_text(sl_json_writer *json, const char *text) {
    begin_item(json);
    put_quoted(json, text);
}

/// The length of the string, number or word at the start of `text`.
static size_t scalar_length(const char *text, size_t size) {
    size_t length = 1;
    if (*text != '"') {
        while (length < size && !strchr(",]}", text[length])) length++;
        return length;
    }
    while (length < size && text[length] != '"') length += text[length] == '\\' ? 2 : 1;
    return length < size ? length + 1 : size;
}

void sl_json_put_written(sl_json_writer *json, const char *text, size_t size) {
    for (const char *at = text, *end = text + size; at < end;) {
        if (*at == '{' || *at == '[')
            open(json, *at++);
        else if (*at == '}' || *at == ']')
            sl_json_put_end(json, *at++);
        else if (*at == ',')
            at++;
        else {
            const size_t length = scalar_length(at, (size_t)(end - at));
            put_scalar(json, at, length);
            at += length;
            if (at == end || *at != ':') continue;
            put_colon(json);
            at++;
        }
    }
}

/// How many bytes follow the first byte of a character; -1 where none starts with it.
static int following(unsigned char first) {
    if (first < 0x80) return 0;
    if (first >= 0xc2 && first < 0xe0) return 1;
    if (first >= 0xe0 && first < 0xf0) return 2;
    return first >= 0xf0 && first < 0xf5 ? 3 : -1;
}

bool sl_text_is_utf8(const char *text) {
    for (const unsigned char *at = (const unsigned char *)text; *at;) {
        const unsigned char first = *at++;
        const int more = following(first);
        if (more < 0) return false;
        // Too long for its character, half of a surrogate pair, or past U+10FFFF.
        if ((first == 0xe0 && *at < 0xa0) || (first == 0xed && *at >= 0xa0) ||
            (first == 0xf0 && *at < 0x90) || (first == 0xf4 && *at >= 0x90))
            return false;
        for (int i = 0; i < more; i++)
            if ((*at++ & 0xc0) != 0x80) return false;
    }
    return true;
}
