/// Style sheets in drawings (CSS 2.1), as far as they hide or move: Illustrator and others write
/// the looks of shapes as classes. Of several declarations about an element one counts
/// (CSS 2.1, 6.4): first those that are !important, then the element's own style, then the rule
/// whose selector has more ids, classes and names of elements, then the later one. Attributes come
/// last.
///
/// Known are selectors of names, .classes, #ids and *, one within another: "g.walls .no, #a". Rules
/// are sorted by one part that an element must have, so that an element is held against few of
/// them.
///
/// A shape is seen if it is not hidden, nothing about it is clear, and its inside or its line is
/// painted. By default the inside is (fill:black) and the line is not (stroke:none).
#include "io/svg/svg_style.h"

#include "base/base.h"

#include "io/parts/document.h"
#include "io/svg/svg_colour.h"

#include <stdlib.h>

/// Up to this opacity nothing is seen.
#define LEAST_OPACITY 0.03

static const char blanks[] = " \t\r\n\f";

static const char *const names[SLI_SVG_PROPERTIES] = {
    [SLI_SVG_DISPLAY] = "display",
    [SLI_SVG_VISIBILITY] = "visibility",
    [SLI_SVG_OPACITY] = "opacity",
    [SLI_SVG_FILL] = "fill",
    [SLI_SVG_STROKE] = "stroke",
    [SLI_SVG_FILL_OPACITY] = "fill-opacity",
    [SLI_SVG_STROKE_OPACITY] = "stroke-opacity",
    [SLI_SVG_STROKE_WIDTH] = "stroke-width",
    [SLI_SVG_CLIP_PATH] = "clip-path",
    [SLI_SVG_TRANSFORM] = "transform",
    [SLI_SVG_TRANSFORM_ORIGIN] = "transform-origin",
    [SLI_SVG_TRANSFORM_BOX] = "transform-box",
    [SLI_SVG_ROTATE] = "rotate",
    [SLI_SVG_SCALE] = "scale",
    [SLI_SVG_TRANSLATE] = "translate",
};

static bool paints(int property) {
    return property >= SLI_SVG_OPACITY && property <= SLI_SVG_STROKE_WIDTH;
}

#define IMPORTANT ((uint64_t)1 << 63)
#define OWN_STYLE ((uint64_t)1 << 62)

/// The declarations that count so far.
typedef struct declared {
    sli_word values[SLI_SVG_PROPERTIES];
    uint64_t weights[SLI_SVG_PROPERTIES];
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
    if (!value.length || (d->values[property].length && weight < d->weights[property])) return;
    d->values[property] = value;
    d->weights[property] = weight;
}

/// Reads "name: value; name: value !important".
static void declare_all(declared *d, sli_word body, uint64_t weight) {
    const char *end = body.at + body.length;
    for (const char *at = body.at; at < end; at++) {
        const char *stop = find(at, end, ";"), *colon = find(at, stop, ":");
        const char *value = colon + (colon < stop), *mark = find(value, stop, "!");
        const sli_word name = trimmed(at, colon);
        for (int i = 0; i < SLI_SVG_PROPERTIES; i++)
            if (sli_word_is(name, names[i]))
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

/// The first part of the last compound.
static sli_word key_of(sli_word selector) {
    sli_word compound = last_compound(&selector);
    return next_part(&compound);
}

/// Whether a selector is of elements that somebody points at: no drawing begins like that.
static bool waits(sli_word selector) {
    static const char *const states[] = {":hover", ":active", ":focus"};
    for (int i = 0; i < 3; i++)
        for (size_t k = 0; k + strlen(states[i]) <= selector.length; k++)
            if (memcmp(selector.at + k, states[i], strlen(states[i])) == 0) return true;
    return false;
}

static sl_status add_rules(sl_context *context, sli_svg_style *style, sli_word selectors,
                           sli_word body) {
    const char *end = selectors.at + selectors.length;
    declared found = {0};
    bool any = false, moves = false, painted = false;
    declare_all(&found, body, 0);
    for (int i = 0; i < SLI_SVG_PROPERTIES; i++) {
        any |= found.values[i].length > 0;
        painted |= found.values[i].length && paints(i);
        moves |= found.values[i].length && !paints(i);
    }
    if (!any) return SL_OK;
    for (const char *at = selectors.at; at < end; at++) {
        const char *stop = find(at, end, ",");
        const sli_word selector = trimmed(at, stop);
        at = stop;
        if (!selector.length || find(selector.at, stop, ">+~:[|\\") < stop) {
            style->unread += moves;
            style->paint_unread |= painted && !waits(selector);
            continue;
        }
        SL_TRY(SL_ARRAY_ROOM(context, &style->rules, 1));
        const size_t number = ++style->rules.count;
        style->rules.items[number - 1] =
            (sli_svg_rule){key_of(selector), selector, body, weight_of(selector, number)};
    }
    return SL_OK;
}

/// The first semicolon or bracket, but for what stands in quotes or in round brackets.
static const char *find_end(const char *at, const char *end) {
    char within = '\0';
    for (; at < end; at++) {
        if (within)
            within = *at == within ? '\0' : within;
        else if (*at == '"' || *at == '\'')
            within = *at;
        else if (*at == '(')
            within = ')';
        else if (*at == ';' || *at == '{')
            break;
    }
    return at;
}

/// The end of an at-rule: a semicolon, or the end of its block.
static const char *pass_at_rule(const char *at, const char *end) {
    at = find_end(at, end);
    if (at == end || *at == ';') return at;
    for (size_t depth = 0; at < end; at++) {
        depth += *at == '{';
        if (*at == '}' && --depth == 0) return at;
    }
    return end;
}

static bool says(const char *at, const char *end, const char *word) {
    for (const size_t length = strlen(word); at + length <= end; at++)
        if (memcmp(at, word, length) == 0) return true;
    return false;
}

/// Whether an at-rule may say how shapes look: not a sheet of fonts, nor rules for dark screens.
static bool may_paint(const char *at, const char *end) {
    const char *stop = find_end(at, end);
    if (strncmp(at, "@import", 7) == 0) return !says(at, stop, "font");
    return strncmp(at, "@media", 6) == 0 && !says(at, stop, "prefers-color-scheme: dark") &&
           !says(at, stop, "prefers-color-scheme:dark");
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
            const bool rules = may_paint(at, end);
            style->unread += rules;
            style->paint_unread |= rules;
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

static int compare_words(sli_word a, sli_word b) {
    const size_t least = a.length < b.length ? a.length : b.length;
    const int order = least ? memcmp(a.at, b.at, least) : 0;
    return order ? order : (a.length > b.length) - (a.length < b.length);
}

static int compare_rules(const void *left, const void *right) {
    const sli_svg_rule *a = left, *b = right;
    return compare_words(a->key, b->key);
}

static sl_status read_sheets(sl_context *context, const xmlNode *node, sli_svg_style *style) {
    for (; node; node = node->next) {
        if (node->type != XML_ELEMENT_NODE) continue;
        SL_TRY(read_sheets(context, node->children, style));
        if (!sli_xml_is(node, "style") || !is_css(node)) continue;
        SL_TRY(SL_ARRAY_ROOM(context, &style->sheets, 1));
        char *text = style->sheets.items[style->sheets.count] = sli_xml_content(node);
        if (!text) return sl_fail_memory(context);
        style->sheets.count++;
        SL_TRY(read_sheet(context, style, text));
    }
    return SL_OK;
}

sl_status sli_svg_style_read(sl_context *context, const xmlNode *root, sli_svg_style *style) {
    // A sheet in another file, which stands before the drawing.
    for (const xmlNode *before = root->prev; before; before = before->prev)
        style->paint_unread |= before->type == XML_PI_NODE &&
                               strcmp((const char *)before->name, "xml-stylesheet") == 0;
    SL_TRY(read_sheets(context, root, style));
    const size_t count = style->rules.count;
    if (count) qsort(style->rules.items, count, sizeof *style->rules.items, compare_rules);
    for (size_t i = 0, first = 0; i < count; i++) {
        if (compare_rules(&style->rules.items[first], &style->rules.items[i]) != 0) first = i;
        if (i - first + 1 > style->same_key) style->same_key = i - first + 1;
    }
    return SL_OK;
}

void sli_svg_style_destroy(sl_context *context, sli_svg_style *style) {
    for (size_t i = 0; i < style->sheets.count; i++) sli_xml_free(style->sheets.items[i]);
    sl_free(context, style->sheets.items);
    sl_free(context, style->rules.items);
}

// --- an element

/// The order of a key and of ".a", whose sign and word come apart. A sign of 0 is none.
static int compare_key(sli_word key, char sign, sli_word word) {
    if (!sign) return compare_words(key, word);
    if (!key.length || *key.at != sign)
        return key.length && (unsigned char)*key.at > (unsigned char)sign ? 1 : -1;
    return compare_words((sli_word){key.at + 1, key.length - 1}, word);
}

/// Declares what the rules of a key say of an element.
static void declare_rules(declared *d, const sli_svg_style *style, const xmlNode *node, char sign,
                          sli_word word) {
    size_t low = 0, high = style->rules.count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (compare_key(style->rules.items[middle].key, sign, word) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    for (; low < style->rules.count; low++) {
        const sli_svg_rule *rule = &style->rules.items[low];
        if (compare_key(rule->key, sign, word) != 0) return;
        if (selector_matches(rule->selector, node)) declare_all(d, rule->body, rule->weight);
    }
}

/// So many classes of one element are looked up.
enum { MOST_CLASSES = 256 };

static void declare_sheets(declared *d, const sli_svg_style *style, const xmlNode *node) {
    if (!style->rules.count) return;
    const char *name = (const char *)node->name;
    char *id = sli_xml_attribute(node, "id"), *classes = sli_xml_attribute(node, "class");
    declare_rules(d, style, node, '*', (sli_word){"", 0});
    declare_rules(d, style, node, 0, (sli_word){name, strlen(name)});
    if (id) declare_rules(d, style, node, '#', (sli_word){id, strlen(id)});
    const char *at = classes ? classes + strspn(classes, blanks) : "";
    for (int i = 0; *at && i < MOST_CLASSES; i++) {
        const size_t length = strcspn(at, blanks);
        declare_rules(d, style, node, '.', (sli_word){at, length});
        at += length;
        at += strspn(at, blanks);
    }
    sli_xml_free(id);
    sli_xml_free(classes);
}

void sli_svg_look_read(const sli_svg_style *style, const xmlNode *node, sli_svg_look *look) {
    declared found = {0};
    *look = (sli_svg_look){0};
    for (const xmlAttr *each = node->properties; each; each = each->next) {
        const char *name = (const char *)each->name;
        for (int i = 0; i < SLI_SVG_ROTATE; i++) {
            if (look->held[i] || strcmp(name, names[i]) != 0) continue;
            char *text = look->held[i] = sli_xml_attribute(node, name);
            if (text) declare(&found, i, trimmed(text, text + strlen(text)), 0);
        }
    }
    declare_sheets(&found, style, node);
    char *own = look->held[SLI_SVG_PROPERTIES] = sli_xml_attribute(node, "style");
    if (own) blank_comments(own);
    if (own) declare_all(&found, (sli_word){own, strlen(own)}, OWN_STYLE);
    memcpy(look->values, found.values, sizeof look->values);
}

void sli_svg_look_free(sli_svg_look *look) {
    for (int i = 0; i <= SLI_SVG_PROPERTIES; i++) sli_xml_free(look->held[i]);
}

bool sli_svg_hides(const sli_svg_style *style, const xmlNode *node) {
    sli_svg_look look;
    sli_svg_look_read(style, node, &look);
    const bool hides = sli_word_is(look.values[SLI_SVG_DISPLAY], "none");
    sli_svg_look_free(&look);
    return hides;
}

// --- paint

/// Whether a value is said here, and not that of the element about.
static bool is_said(sli_word value) {
    return value.length && !sli_word_is(value, "inherit");
}

static bool is_zero(sli_word value) {
    double number = 1;
    const size_t length = sli_number_length(value.at, value.length);
    return length && sl_number_read(value.at, length, &number) && number <= 0;
}

/// An opacity, of all or of one paint; 1 where it is not known.
static double opacity_of(sli_word value) {
    double number = 1;
    const size_t length = sli_number_length(value.at, value.length);
    if (!length || !sl_number_read(value.at, length, &number)) return 1;
    if (length < value.length && value.at[length] == '%') number /= 100;
    return number < 0 ? 0 : number > 1 ? 1 : number;
}

/// Whether an opacity is so low that nothing is seen: areas that are to be clicked have such.
static bool is_clear(sli_word value) {
    return opacity_of(value) <= LEAST_OPACITY;
}

/// The colours of an element's paint, and how opaque they are.
static void read_colours(sli_svg_paint *paint, const sli_word *values) {
    double own;
    if (is_said(values[SLI_SVG_OPACITY])) paint->opacity *= opacity_of(values[SLI_SVG_OPACITY]);
    if (is_said(values[SLI_SVG_FILL_OPACITY]))
        paint->fill_opacity = opacity_of(values[SLI_SVG_FILL_OPACITY]);
    if (is_said(values[SLI_SVG_STROKE_OPACITY]))
        paint->line_opacity = opacity_of(values[SLI_SVG_STROKE_OPACITY]);
    if (is_said(values[SLI_SVG_FILL])) {
        paint->fill = sli_svg_colour(values[SLI_SVG_FILL], &own);
        paint->fill_opacity *= own;
    }
    if (is_said(values[SLI_SVG_STROKE])) {
        paint->line = sli_svg_colour(values[SLI_SVG_STROKE], &own);
        paint->line_opacity *= own;
    }
}

/// "none", "transparent", or a colour that ends with an opacity of 0, as in "rgba(1, 2, 3, 0)".
static bool is_no_paint(sli_word value) {
    if (sli_word_is(value, "none") || sli_word_is(value, "transparent")) return true;
    if (value.length == 9 && *value.at == '#') return memcmp(value.at + 7, "00", 2) == 0;
    if (value.length == 5 && *value.at == '#') return value.at[4] == '0';
    if (value.length < 6 || memcmp(value.at, "rgba(", 5) != 0) return false;
    const char *end = value.at + value.length, *last = end;
    while (last > value.at && !strchr(",/", last[-1])) last--;
    return is_clear(trimmed(last, end));
}

sli_svg_paint sli_svg_paint_in(sli_svg_paint outer, const sli_svg_look *look) {
    sli_svg_paint paint = outer;
    const sli_word *values = look->values;
    if (is_said(values[SLI_SVG_VISIBILITY]))
        paint.hidden = sli_word_is(values[SLI_SVG_VISIBILITY], "hidden") ||
                       sli_word_is(values[SLI_SVG_VISIBILITY], "collapse");
    if (is_said(values[SLI_SVG_OPACITY])) paint.clear |= is_clear(values[SLI_SVG_OPACITY]);
    if (is_said(values[SLI_SVG_FILL])) paint.no_fill = is_no_paint(values[SLI_SVG_FILL]);
    if (is_said(values[SLI_SVG_STROKE])) paint.stroke = !is_no_paint(values[SLI_SVG_STROKE]);
    if (is_said(values[SLI_SVG_FILL_OPACITY]))
        paint.clear_fill = is_clear(values[SLI_SVG_FILL_OPACITY]);
    if (is_said(values[SLI_SVG_STROKE_OPACITY]))
        paint.clear_stroke = is_clear(values[SLI_SVG_STROKE_OPACITY]);
    if (is_said(values[SLI_SVG_STROKE_WIDTH])) {
        const sli_word width = values[SLI_SVG_STROKE_WIDTH];
        const size_t length = sli_number_length(width.at, width.length);
        paint.width = 0;
        if (length && !sl_number_read(width.at, length, &paint.width)) paint.width = 0;
        paint.thin = is_zero(width);
    }
    read_colours(&paint, values);
    return paint;
}

bool sli_svg_is_seen(sli_svg_paint paint, bool all) {
    if (paint.hidden || paint.clear) return false;
    const bool filled = !paint.no_fill && !paint.clear_fill;
    return !all || filled || (paint.stroke && !paint.clear_stroke && !paint.thin);
}
