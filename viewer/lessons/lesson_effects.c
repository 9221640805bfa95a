/// The lesson of effects: cell by cell what the eye's cell sees, and which doors, mirrors and glass
/// decide that.
#include "lessons/learn.h"
#include "sightline/draw.h"
#include "sightline/support.h"

#include <stdio.h>
#include <string.h>

/// A search past walls alone is followed no farther than this.
#define STEPS_MOST 20000

enum { DOORS_TEXT = 256 };

static bool fits(const document_state *document) {
    return sl_plan_make(&document->map).effects != 0;
}

static size_t length(const lesson_state *lesson) {
    return lesson->effects.count;
}

// --- recording

/// For each cell, the step at which a search past walls alone first enters it; 0 for none.
static sl_status find_entries(sl_context *context, lesson_state *lesson,
                              const document_state *document, uint32_t source, size_t *entries) {
    sl_steps_options options = sl_steps_options_default();
    options.sight = document->baked->visibility.sight;
    options.most = STEPS_MOST;
    SL_TRY(sl_steps_record(context, &document->baked->space, &options, source, &lesson->steps));
    for (size_t i = 1; i < lesson->steps.count; i++) {
        const sl_step *s = &lesson->steps.steps[i];
        if (s->kind == SL_STEP_ENTER && s->first) entries[s->cell] = i;
    }
    return SL_OK;
}

static effect_fact fact_of(const document_state *document, uint32_t source, uint32_t cell,
                           bool entered) {
    const sl_visibility *v = &document->baked->visibility;
    const bool mutual = sl_plan_make(&document->map).mutual;
    const bool sees = sl_pvs_sees(&v->pvs, source, cell);
    const bool seen = mutual ? sees : sl_pvs_sees(&v->pvs, cell, source);
    if (sees && sl_door_sets_alternative(&v->doors, source, cell, 0, NULL)) return FACT_DOORS;
    if (sees) return seen ? FACT_SEEN : FACT_SEES;
    if (v->mirrored.cell_count && sl_pvs_sees(&v->mirrored, source, cell)) return FACT_MIRROR;
    if (seen) return FACT_WATCHED;
    if (!entered) return FACT_NONE;
    return document->map.range > 0 ? FACT_RANGE : FACT_DARK;
}

static sl_status collect(sl_context *context, lesson_state *lesson, const document_state *document,
                         uint32_t source, const size_t *entries) {
    for (uint32_t cell = 0; cell < document->baked->space.cell_count; cell++) {
        if (cell == source) continue;
        const effect_fact fact = fact_of(document, source, cell, entries[cell] != 0);
        if (fact == FACT_NONE) continue;
        SL_TRY(SL_ARRAY_ROOM(context, &lesson->effects, 1));
        lesson->effects.items[lesson->effects.count++] = (effect_step){cell, fact, entries[cell]};
    }
    return SL_OK;
}

static sl_status record(sl_context *context, lesson_state *lesson, const document_state *document,
                        uint32_t source) {
    if (!document_has_rows(document)) return SL_OK;
    const uint32_t cells = document->baked->space.cell_count;
    size_t *entries = sl_alloc_array(context, cells, sizeof *entries);
    if (!entries) return SL_NO_MEMORY;
    sl_status status = find_entries(context, lesson, document, source, entries);
    if (status == SL_OK) status = collect(context, lesson, document, source, entries);
    sl_free(context, entries);
    return status;
}

// --- words

static const char *const effects_code[] = {
    "search(cell, sequence, doors):",
    "    cell is seen while doors are open",
    "    for each portal out of cell:",
    "        if it has glass, dark from here: pass it over",
    "        if no line stabs sequence + portal: pass it over",
    "        if its shortest is out of range: pass it over",
    "        search(cell behind, sequence + portal,",
    "            doors + the portal's)",
    "    for each mirror at cell, up to the depth:",
    "        search(cell, sequence + mirror, doors), reflected",
};

static const char *const *code(const lesson_state *lesson, const document_state *document,
                               size_t *count, size_t *lit) {
    static const size_t lines[] = {
        [FACT_SEEN] = 6,    [FACT_SEES] = 6, [FACT_DOORS] = 1, [FACT_MIRROR] = 9,
        [FACT_WATCHED] = 3, [FACT_DARK] = 3, [FACT_RANGE] = 5,
    };
    (void)document;
    *count = sizeof effects_code / sizeof *effects_code;
    *lit = lines[lesson->effects.items[lesson->at].fact];
    return effects_code;
}

static void append_words(char text[DOORS_TEXT], const char *between, const char *more) {
    const size_t used = strlen(text);
    snprintf(text + used, DOORS_TEXT - used, "%s%s", used ? between : "", more);
}

/// One alternative: "west and east"; *open says whether all of them are open.
static void name_doors(const sl_map *map, const bool *doors, char text[DOORS_TEXT], bool *open) {
    text[0] = '\0';
    *open = true;
    for (size_t i = 0; i < map->door_count; i++) {
        if (!doors[i]) continue;
        append_words(text, " and ", map->doors[i].name);
        *open &= map->doors[i].open;
    }
}

enum { DOORS_MOST = 1024 };

/// "west and east are open, or north"; *now says whether one of the alternatives is open.
static void name_alternatives(const document_state *document, uint32_t source, uint32_t cell,
                              char text[DOORS_TEXT], bool *now) {
    const sl_map *map = &document->map;
    const sl_door_sets *sets = &document->baked->visibility.doors;
    bool doors[DOORS_MOST] = {false};
    text[0] = '\0';
    *now = false;
    if (map->door_count > DOORS_MOST) return;
    for (uint32_t i = 0; sl_door_sets_alternative(sets, source, cell, i, doors); i++) {
        char one[DOORS_TEXT];
        bool open;
        name_doors(map, doors, one, &open);
        append_words(text, ", or ", one);
        *now |= open;
        memset(doors, 0, sizeof doors);
    }
}

static void say(const lesson_state *lesson, const document_state *document, char text[SENTENCE]) {
    const effect_step *s = &lesson->effects.items[lesson->at];
    const uint32_t from = lesson->source, to = s->cell;
    char doors[DOORS_TEXT];
    bool now;
    switch (s->fact) {
    case FACT_SEEN:
        snprintf(text, SENTENCE, "Cell %u is seen past walls alone%s.", to,
                 document->map.door_count ? ", whatever doors are shut" : "");
        return;
    case FACT_SEES:
        snprintf(text, SENTENCE,
                 "Cell %u is seen from cell %u, which it does not see: glass is dark that way.", to,
                 from);
        return;
    case FACT_DOORS:
        name_alternatives(document, from, to, doors, &now);
        snprintf(text, SENTENCE, "Cell %u is seen while these doors are open: %s. Now it is%s.", to,
                 doors, now ? "" : " not");
        return;
    case FACT_MIRROR:
        snprintf(text, SENTENCE, "Cell %u is seen by mirror alone: the search goes on reflected.",
                 to);
        return;
    case FACT_WATCHED:
        snprintf(text, SENTENCE,
                 "Cell %u is not seen from cell %u, but sees it: glass is dark from here.", to,
                 from);
        return;
    case FACT_RANGE:
        snprintf(text, SENTENCE,
                 "A line passes the portals to cell %u, but the shortest is longer than %g%s.", to,
                 document->map.range, document->map.oneway_count ? ", or glass is dark" : "");
        return;
    case FACT_DARK:
        snprintf(text, SENTENCE, "A line passes the portals to cell %u, but glass is dark on it.",
                 to);
        return;
    case FACT_NONE:
        return;
    }
}

static void account(const lesson_state *lesson, char text[SENTENCE]) {
    unsigned counts[FACT_NONE + 1] = {0};
    for (size_t i = 0; i <= lesson->at; i++) counts[lesson->effects.items[i].fact]++;
    snprintf(text, SENTENCE,
             "%u cells seen past walls alone, %u a matter of doors, %u by mirror, %u one way only, "
             "%u hidden by glass or out of range.",
             counts[FACT_SEEN], counts[FACT_DOORS], counts[FACT_MIRROR],
             counts[FACT_SEES] + counts[FACT_WATCHED], counts[FACT_DARK] + counts[FACT_RANGE]);
}

static uint32_t cell_of(const lesson_state *lesson, size_t step) {
    return lesson->effects.items[step].cell;
}

/// A step that is not about walls alone.
static bool finds(const lesson_state *lesson, size_t step) {
    return lesson->effects.items[step].fact != FACT_SEEN;
}

static bool rejects(const lesson_state *lesson, size_t step) {
    const effect_fact fact = lesson->effects.items[step].fact;
    return fact == FACT_WATCHED || fact == FACT_DARK || fact == FACT_RANGE;
}

// --- drawing

static sl_colour colour_of(const sl_palette *palette, effect_fact fact) {
    switch (fact) {
    case FACT_SEEN:
    case FACT_SEES:
        return palette->seen[0];
    case FACT_DOORS:
        return palette->portal;
    case FACT_MIRROR:
    case FACT_WATCHED:
        return palette->door;
    default:
        return palette->start;
    }
}

static void below(learn_state *learn, const sl_frame *frame) {
    const lesson_state *lesson = &learn->lesson;
    const sl_space *space = &learn->document->baked->space;
    const sl_palette *palette = &learn->ui->palette;
    for (size_t i = 0; i <= lesson->at; i++) {
        const effect_step *s = &lesson->effects.items[i];
        const bool here = i == lesson->at;
        sl_draw_cell(learn->ui->cairo, space, frame, s->cell, colour_of(palette, s->fact),
                     here ? 0.7 : 0.3, here ? 3 * frame->unit : frame->unit);
    }
    sl_draw_cell(learn->ui->cairo, space, frame, lesson->source, palette->source_edge, 0.55,
                 2 * frame->unit);
}

/// Draws the doors of all alternatives. A shut door is drawn as what stops the line.
static void draw_doors(learn_state *learn, const sl_frame *frame, uint32_t cell) {
    const sl_map *map = &learn->document->map;
    const sl_door_sets *sets = &learn->document->baked->visibility.doors;
    bool doors[DOORS_MOST] = {false};
    if (map->door_count > DOORS_MOST) return;
    for (uint32_t i = 0; sl_door_sets_alternative(sets, learn->lesson.source, cell, i, doors);) i++;
    for (size_t i = 0; i < map->door_count; i++)
        if (doors[i])
            sl_draw_line(learn->ui->cairo, frame, map->doors[i].segment.a, map->doors[i].segment.b,
                         map->doors[i].open ? learn->ui->palette.portal : learn->ui->palette.start,
                         7 * frame->unit);
}

/// Draws the line of a search past walls alone.
static void draw_line(learn_state *learn, const sl_frame *frame, const effect_step *s) {
    const sl_space *space = &learn->document->baked->space;
    uint32_t directed[SL_DUAL_PORTALS_MOST];
    sl_portal_ends ends[SL_DUAL_PORTALS_MOST];
    sl_dual dual;
    const uint32_t count =
        sl_steps_sequence(&learn->lesson.steps, s->entry, directed, SL_DUAL_PORTALS_MOST);
    if (!count || count > SL_DUAL_PORTALS_MOST) return;
    for (uint32_t i = 0; i < count; i++)
        ends[i] =
            (sl_portal_ends){space->directed[directed[i]].left, space->directed[directed[i]].right};
    const bool stops =
        !present_sees(learn->context, &learn->view->present, learn->lesson.source, s->cell);
    sl_draw_portal_ends(learn->ui->cairo, &learn->ui->palette, frame, ends, count, stops);
    sl_dual_make(ends, count, count, &dual);
    if (!dual.corner_count) return;
    const sl_line line = sl_dual_line_at(&dual, dual.best, -3, 3);
    sl_draw_line(learn->ui->cairo, frame, line.a, line.b,
                 stops ? learn->ui->palette.start : learn->ui->palette.ink, 2 * frame->unit);
}

static void above(learn_state *learn, const sl_frame *frame) {
    const effect_step *s = &learn->lesson.effects.items[learn->lesson.at];
    if (s->entry) draw_line(learn, frame, s);
    if (s->fact == FACT_DOORS) draw_doors(learn, frame, s->cell);
}

const subject_row lesson_effects = {
    .title = "What the map calls for",
    .of_eye = true,
    .fits = fits,
    .record = record,
    .length = length,
    .sentence = say,
    .code = code,
    .account = account,
    .cell = cell_of,
    .finds = finds,
    .rejects = rejects,
    .found = "Effect",
    .rejected = "Hidden",
    .below = below,
    .above = above,
};
