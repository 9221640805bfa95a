/// Style sheets in drawings (CSS 2.1), as far as they hide: Illustrator and others write the looks
/// of shapes as classes. Of several declarations about an element one counts (CSS 2.1, 6.4): first
/// those that are !important, then the element's own style, then the rule whose selector has more
/// ids, classes and names of elements, then the later one. Attributes come last.
///
/// Known are selectors of names, .classes, #ids and *, one within another: "g.walls .no, #a".
#include "io/svg/svg_style.h"

#include "io/parts/document.h"

static const char blanks[] = " \t\r\n\f";

enum { DISPLAY, VISIBILITY, PROPERTIES };
static const char *const names[] = {"display", "visibility"};
static const char *const hiding[] = {"none", "hidden"};

#define IMPORTANT ((uint64_t)1 << 63)
#define OWN_STYLE ((uint64_t)1 << 62)

/// The declaration of a property that counts so far.
typedef struct declared {
    bool any, hides;
    uint64_t weight;
} declared;

static sli_word trimmed(const char *at, const char *end) {
    while (at < end && strchr(blanks, *at)) at++;
    while (end > at && strchr(blanks, end[-1])) end--;
    return (sli_word){at, (size_t)(end - at)};
}

/// Where one of these characters stands, else the end.
static const char *find(const char *at, const char *end, const char *any) {
    while (at < end && !strchr(any, *at)) at++;
    return at;
}

static void declare(declared *d, int property, sli_word value, uint64_t weight) {
    if (d[property].any && weight < d[property].weight) return;
    d[property] = (declared){true, sli_word_is(value, hiding[property]), weight};
}

/// Reads "name: value; name: value !important".
static void declare_all(declared *d, sli_word body, uint64_t weight) {
    const char *end = body.at + body.length;
    for (const char *at = body.at; at < end; at++) {
        const char *stop = find(at, end, ";"), *colon = find(at, stop, ":");
        const char *value = colon + (colon < stop), *mark = find(value, stop, "!");
        for (int i = 0; i < PROPERTIES; i++)
            if (sli_word_is(trimmed(at, colon), names[i]))
                declare(d, i, trimmed(value, mark), mark < stop ? weight | IMPORTANT : weight);
        at = stop;
    }
}

// --- selectors

/// The next part of a compound selector: "#a" of "#a.b". None where it is empty.
static sli_word next_part(sli_word *rest) {
    const char *end = rest->at + rest->length;
    const sli_word part = {rest->at,
                           rest->length ? (size_t)(find(rest->at + 1, end, ".#") - rest->at) : 0};
    *rest = (sli_word){part.at + part.length, rest->length - part.length};
    return part;
}

/// The last compound of a selector: ".b" of "g .b". Takes it away.
static sli_word last_compound(sli_word *selector) {
    const char *end = selector->at + selector->length, *at = end;
    while (at > selector->at && !strchr(blanks, at[-1])) at--;
    *selector = trimmed(selector->at, at);
    return (sli_word){at, (size_t)(end - at)};
}

static bool has_class(const xmlNode *node, sli_word name) {
    char *text = sli_xml_attribute(node, "class");
    bool found = false;
    for (const char *at = text; at && *at && !found;) {
        const size_t length = strcspn(at, blanks);
        found = length == name.length && memcmp(at, name.at, length) == 0;
        at += length;
        at += strspn(at, blanks);
    }
    sli_xml_free(text);
    return found;
}

static bool has_id(const xmlNode *node, sli_word id) {
    char *text = sli_xml_attribute(node, "id");
    const bool same = text && sli_word_is(id, text);
    sli_xml_free(text);
    return same;
}

static bool compound_matches(sli_word compound, const xmlNode *node) {
    for (sli_word part; (part = next_part(&compound)).length;) {
        const sli_word name = {part.at + 1, part.length - 1};
        const bool matches = *part.at == '.'   ? has_class(node, name)
                             : *part.at == '#' ? has_id(node, name)
                                               : sli_word_is(part, "*") ||
                                                     sli_word_is(part, (const char *)node->name);
        if (!matches) return false;
    }
    return true;
}

/// An outer compound is that of the nearest element that it fits: any farther one fits no better.
static bool selector_matches(sli_word selector, const xmlNode *node) {
    if (!compound_matches(last_compound(&selector), node)) return false;
    while (selector.length) {
        const sli_word outer = last_compound(&selector);
        do node = node->parent;
        while (node && !(node->type == XML_ELEMENT_NODE && compound_matches(outer, node)));
        if (!node) return false;
    }
    return true;
}

/// Eight bits each for ids, classes and names, above the number of the rule.
static uint64_t weight_of(sli_word selector, size_t number) {
    uint64_t ids = 0, classes = 0, elements = 0;
    while (selector.length) {
        sli_word compound = last_compound(&selector);
        for (sli_word part; (part = next_part(&compound)).length;)
            ++*(*part.at == '#' ? &ids : *part.at == '.' ? &classes : &elements);
    }
    return (ids & 0xff) << 48 | (classes & 0xff) << 40 | (elements & 0xff) << 32 |
           (number & UINT32_MAX);
}

// --- sheets

static sl_status add_rules(sl_context *context, sli_svg_style *style, sli_word selectors,
                           sli_word body) {
    const char *end = selectors.at + selectors.length;
    declared found[PROPERTIES] = {0};
    declare_all(found, body, 0);
    if (!found[DISPLAY].any && !found[VISIBILITY].any) return SL_OK;
    for (const char *at = selectors.at; at < end; at++) {
        const char *stop = find(at, end, ",");
        const sli_word selector = trimmed(at, stop);
        at = stop;
        if (!selector.length || find(selector.at, stop, ">+~:[|\\") < stop) {
            style->unread++;
            continue;
        }
        SL_TRY(SL_ARRAY_ROOM(context, &style->rules, 1));
        const size_t number = ++style->rules.count;
        style->rules.items[number - 1] =
            (sli_svg_rule){selector, body, weight_of(selector, number)};
    }
    return SL_OK;
}

/// The end of an at-rule: a semicolon, or the end of its block.
static const char *pass_at_rule(const char *at, const char *end) {
    at = find(at, end, ";{");
    if (at == end || *at == ';') return at;
    for (size_t depth = 0; at < end; at++) {
        depth += *at == '{';
        if (*at == '}' && --depth == 0) return at;
    }
    return end;
}

static void blank_comments(char *text) {
    for (char *at; (at = strstr(text, "/*"));) {
        const char *stop = strstr(at + 2, "*/");
        const size_t length = stop ? (size_t)(stop + 2 - at) : strlen(at);
        memset(at, ' ', length);
        text = at + length;
    }
}

static sl_status read_sheet(sl_context *context, sli_svg_style *style, char *text) {
    const char *end = text + strlen(text);
    blank_comments(text);
    for (const char *at = text; at < end; at++) {
        at = trimmed(at, end).at;
        if (at < end && *at == '@') {
            style->unread += strncmp(at, "@media", 6) == 0 || strncmp(at, "@import", 7) == 0;
            at = pass_at_rule(at, end);
            continue;
        }
        const char *open = find(at, end, "{"), *close = find(open, end, "}");
        if (open == end) break;
        SL_TRY(add_rules(context, style, trimmed(at, open), trimmed(open + 1, close)));
        at = close;
    }
    return SL_OK;
}

static bool is_css(const xmlNode *node) {
    char *type = sli_xml_attribute(node, "type");
    const bool css = !type || strcmp(type, "text/css") == 0 || !*type;
    sli_xml_free(type);
    return css;
}

sl_status sli_svg_style_read(sl_context *context, const xmlNode *node, sli_svg_style *style) {
    for (; node; node = node->next) {
        if (node->type != XML_ELEMENT_NODE) continue;
        SL_TRY(sli_svg_style_read(context, node->children, style));
        if (!sli_xml_is(node, "style") || !is_css(node)) continue;
        SL_TRY(SL_ARRAY_ROOM(context, &style->sheets, 1));
        char *text = style->sheets.items[style->sheets.count] = sli_xml_content(node);
        if (!text) return sl_fail_memory(context);
        style->sheets.count++;
        SL_TRY(read_sheet(context, style, text));
    }
    return SL_OK;
}

void sli_svg_style_destroy(sl_context *context, sli_svg_style *style) {
    for (size_t i = 0; i < style->sheets.count; i++) sli_xml_free(style->sheets.items[i]);
    sl_free(context, style->sheets.items);
    sl_free(context, style->rules.items);
}

bool sli_svg_hides(const sli_svg_style *style, const xmlNode *node) {
    declared found[PROPERTIES] = {0};
    for (int i = 0; i < PROPERTIES; i++) {
        char *text = sli_xml_attribute(node, names[i]);
        if (text) declare(found, i, trimmed(text, text + strlen(text)), 0);
        sli_xml_free(text);
    }
    for (size_t i = 0; i < style->rules.count; i++)
        if (selector_matches(style->rules.items[i].selector, node))
            declare_all(found, style->rules.items[i].body, style->rules.items[i].weight);
    char *own = sli_xml_attribute(node, "style");
    if (own) declare_all(found, (sli_word){own, strlen(own)}, OWN_STYLE);
    sli_xml_free(own);
    return found[DISPLAY].hides || found[VISIBILITY].hides;
}
