/// A few uses of uses give any number of elements. Each element that has an id is counted once, so
/// the time is that of the file; the sums stay at UINT64_MAX where they would go beyond it. Walls
/// are counted at least: curves as one, where they are not circles.
#include "io/svg/svg_count.h"

#include "base/base.h"
#include "io/parts/document.h"
#include "io/parts/limits.h"

#include <stdlib.h>
#include <string.h>

// --- ids

static int compare_ids(const void *left, const void *right) {
    const sli_svg_id *a = left, *b = right;
    const int order = strcmp(a->id, b->id);
    return order ? order : (a->place > b->place) - (a->place < b->place);
}

static sl_status add_ids(sl_context *context, xmlNode *node, sli_svg_ids *ids) {
    for (; node; node = node->next) {
        if (node->type != XML_ELEMENT_NODE) continue;
        SL_TRY(SL_ARRAY_ROOM(context, &ids->items, 1));
        char *id = sli_xml_attribute(node, "id");
        if (id) {
            ids->items.items[ids->items.count] =
                (sli_svg_id){.id = id, .node = node, .place = ids->items.count};
            ids->items.count++;
        }
        SL_TRY(add_ids(context, node->children, ids));
    }
    return SL_OK;
}

sl_status sli_svg_ids_read(sl_context *context, xmlNode *root, sli_svg_ids *ids) {
    SL_TRY(add_ids(context, root, ids));
    if (ids->items.count)
        qsort(ids->items.items, ids->items.count, sizeof *ids->items.items, compare_ids);
    return SL_OK;
}

void sli_svg_ids_destroy(sl_context *context, sli_svg_ids *ids) {
    for (size_t i = 0; i < ids->items.count; i++) sli_xml_free(ids->items.items[i].id);
    sl_free(context, ids->items.items);
    *ids = (sli_svg_ids){0};
}

static sli_svg_id *find(const sli_svg_ids *ids, const char *id) {
    size_t low = 0, high = ids->items.count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (strcmp(ids->items.items[middle].id, id) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    const bool found = low < ids->items.count && strcmp(ids->items.items[low].id, id) == 0;
    return found ? &ids->items.items[low] : NULL;
}

xmlNode *sli_svg_find(const sli_svg_ids *ids, const char *id) {
    const sli_svg_id *found = find(ids, id);
    return found ? found->node : NULL;
}

// --- shapes

/// The lines and curves of path data. Numbers that stand together as flags of arcs count as one.
static uint64_t count_path(const char *data) {
    static const char letters[] = "MLHVCSQTAZ", taken[] = {2, 2, 1, 1, 6, 4, 4, 2, 7, 0};
    uint64_t parts = 0, numbers = 0;
    size_t takes = 0;
    for (const char *at = data, *end = data + strlen(data); at < end;) {
        const size_t length = sli_number_length(at, (size_t)(end - at));
        const char capital = (char)(*at & ~0x20);
        const char *letter = capital ? strchr(letters, capital) : NULL; // a space has none
        numbers += length > 0;
        if (takes && numbers == takes) parts++, numbers = 0;
        if (!length && letter) {
            takes = (size_t)taken[letter - letters];
            numbers = 0;
        }
        at += length ? length : 1;
    }
    return parts;
}

static uint64_t count_points(const char *data) {
    uint64_t numbers = 0;
    for (const char *at = data, *end = data + strlen(data); at < end;) {
        const size_t length = sli_number_length(at, (size_t)(end - at));
        numbers += length > 0;
        at += length ? length : 1;
    }
    return numbers / 2;
}

static uint64_t walls_of(const xmlNode *node, const sl_import_options *options) {
    const bool path = sli_xml_is(node, "path");
    if (sli_xml_is(node, "line")) return 1;
    if (sli_xml_is(node, "rect")) return 4;
    if (sli_xml_is(node, "circle") || sli_xml_is(node, "ellipse"))
        return options->tolerance > 0 ? 4 : 32;
    if (!path && !sli_xml_is(node, "polyline") && !sli_xml_is(node, "polygon")) return 0;
    char *data = sli_xml_attribute(node, path ? "d" : "points");
    const uint64_t count = !data ? 0 : path ? count_path(data) : count_points(data);
    sli_xml_free(data);
    return count ? count - 1 : 0;
}

// --- all of it

typedef struct counter {
    sl_context *context;
    const char *name;
    const sl_import_options *options;
    const sli_svg_style *style;
    sli_svg_ids *ids;
    bool used; ///< what is counted is used: walls count
} counter;

static sl_status count_children(counter *c, const xmlNode *node, uint64_t depth, sli_svg_id *sum);

static sl_status check_depth(const counter *c, const xmlNode *node, uint64_t depth) {
    return sli_limit_check(c->context, c->name, sli_xml_line(node), SLI_LIMIT_DEPTH, depth,
                           "elements within elements");
}

static sl_status count_element(counter *c, const xmlNode *node, uint64_t depth, sli_svg_id *sum);

/// Counts what a use names, once.
static sl_status count_used(counter *c, const xmlNode *use, uint64_t depth, sli_svg_id *own) {
    if (own->state == SLI_SVG_COUNTING)
        return sl_fail_at(c->context, c->name, sli_xml_line(use),
                          "use: element '%s' holds a use of itself",
                          sli_show((sli_word){own->id, strlen(own->id)}).text);
    if (own->state == SLI_SVG_KNOWN) return SL_OK;
    const bool used = c->used;
    own->state = SLI_SVG_COUNTING;
    c->used = true;
    SL_TRY(sli_xml_is(own->node, "symbol") ? count_children(c, own->node, depth + 1, own)
                                           : count_element(c, own->node, depth + 1, own));
    c->used = used;
    own->state = SLI_SVG_KNOWN;
    return SL_OK;
}

static sl_status count_use(counter *c, const xmlNode *node, uint64_t depth, sli_svg_id *sum) {
    char *link = sli_xml_attribute(node, "href");
    sli_svg_id *own = link && *link == '#' ? find(c->ids, link + 1) : NULL;
    sli_xml_free(link);
    if (!own) return SL_OK; // drawing it says so
    SL_TRY(count_used(c, node, depth, own));
    SL_TRY(check_depth(c, node, sli_limit_sum(depth + 1, own->height)));
    sum->entities = sli_limit_sum(sum->entities, own->entities);
    sum->walls = sli_limit_sum(sum->walls, own->walls);
    if (own->height + 1 > sum->height) sum->height = own->height + 1;
    return SL_OK;
}

static sl_status count_element(counter *c, const xmlNode *node, uint64_t depth, sli_svg_id *sum) {
    static const char *const groups[] = {"g", "a", "svg", "switch"};
    // Rules of style sheets that may fit are held against each element.
    sum->entities = sli_limit_sum(sum->entities, 1 + c->style->same_key / 16);
    if (sli_xml_is(node, "use"))
        return sli_svg_hides(c->style, node) ? SL_OK : count_use(c, node, depth, sum);
    for (size_t i = 0; i < sizeof groups / sizeof *groups; i++)
        if (sli_xml_is(node, groups[i]))
            return sli_svg_hides(c->style, node) ? SL_OK : count_children(c, node, depth, sum);
    if (c->used) sum->walls = sli_limit_sum(sum->walls, walls_of(node, c->options));
    return SL_OK;
}

static sl_status count_children(counter *c, const xmlNode *node, uint64_t depth, sli_svg_id *sum) {
    SL_TRY(check_depth(c, node, depth));
    uint64_t most = sum->height;
    for (const xmlNode *child = node->children; child; child = child->next) {
        if (child->type != XML_ELEMENT_NODE) continue;
        sum->height = 0;
        SL_TRY(count_element(c, child, depth + 1, sum));
        if (sum->height + 1 > most) most = sum->height + 1;
    }
    sum->height = most;
    return SL_OK;
}

sl_status sli_svg_check_amount(sl_context *context, const char *name,
                               const sl_import_options *options, xmlNode *root,
                               const sli_svg_style *style, sli_svg_ids *ids) {
    counter c = {context, name, options, style, ids, false};
    sli_svg_id all = {0};
    SL_TRY(count_children(&c, root, 0, &all));
    SL_TRY(sli_limit_check(context, name, 0, SLI_LIMIT_ENTITIES, all.entities,
                           "the drawing's elements, as often as they are used"));
    return sli_limit_check(context, name, 0, SLI_LIMIT_WALLS, all.walls, "the drawing's uses give");
}
