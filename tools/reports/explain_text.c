/// The words of `sightline explain`.
#include "reports/explain_text.h"

#include "arguments/names.h"
#include "sightline/support.h"

#include <inttypes.h>
#include <stdio.h>

static void print_point(sl_point p) {
    char x[SL_NUMBER_TEXT], y[SL_NUMBER_TEXT];
    sl_number_write(p.x, x);
    sl_number_write(p.y, y);
    printf("(%s,%s)", x, y);
}

static const char *plural(uint64_t count) {
    return count == 1 ? "" : "s";
}

/// Prints a line for each of the first `count` portals of a sequence.
static void print_portals(const sl_space *space, const sl_sequence *sequence, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        const sl_directed_portal *directed = &space->directed[sequence->directed[i]];
        printf("  %2" PRIu32 "  portal %" PRIu32 " into cell %" PRIu32 ", left end ", i + 1,
               directed->portal, directed->cell);
        print_point(directed->left);
        printf(", right end ");
        print_point(directed->right);
        putchar('\n');
    }
}

static uint32_t portal_of(const sl_space *space, const sl_sequence *sequence, uint32_t number) {
    return space->directed[sequence->directed[number]].portal;
}

/// "the left ends (0,1) of portal 3 and (4,1) of portal 9"
static void print_ends(const sl_space *space, const sl_sequence *sequence, bool left) {
    uint32_t count = 0, printed = 0;
    for (uint32_t i = 0; i < sequence->end_count; i++) count += sequence->ends[i].left == left;
    printf("the %s end%s ", left ? "left" : "right", plural(count));
    for (uint32_t i = 0; i < sequence->end_count; i++) {
        const sl_stab_end end = sequence->ends[i];
        if (end.left != left) continue;
        if (printed) printf(printed + 1 < count ? ", " : " and ");
        print_point(sl_sequence_end(space, sequence, end));
        printf(" of portal %" PRIu32, portal_of(space, sequence, end.portal));
        printed++;
    }
}

static void print_line(sl_line line) {
    printf("The line from ");
    print_point(line.a);
    printf(" to ");
    print_point(line.b);
}

static void print_stabbed(const sl_space *space, const sl_explanation *e) {
    const uint32_t count = e->sequence.directed_count;
    printf("Cell %" PRIu32 " sees cell %" PRIu32 " through %" PRIu32 " portal%s%s:\n", e->from,
           e->to, count, plural(count), e->complete ? "; no sightline there crosses fewer" : "");
    print_portals(space, &e->sequence, count);
    print_line(e->witness);
    if (!e->touches)
        puts(" proves it: every left end lies at its left and every right end at its right.");
    else
        puts(" is as near as doubles come: lines that touch no end lie closer together than that.");
}

static void print_grazing(const sl_space *space, const sl_explanation *e) {
    const uint32_t count = e->sequence.directed_count;
    printf("Cell %" PRIu32 " %s cell %" PRIu32 " with %s sight: %s line there only grazes, through "
           "%" PRIu32 " portal%s:\n",
           e->from, e->seen ? "sees" : "does not see", e->to, sight_name(e->sight),
           e->complete ? "every" : "so far every", count, plural(count));
    print_portals(space, &e->sequence, count);
    print_line(e->witness);
    printf(" touches ");
    print_ends(space, &e->sequence, true);
    printf(" and ");
    print_ends(space, &e->sequence, false);
    printf(". No line passes strictly between them: %s.\n",
           sl_sequence_reason(space, &e->sequence));
    printf("%s sight would%s see the cell.\n", e->seen ? "Open" : "Closed", e->seen ? " not" : "");
}

static void print_miss(const sl_space *space, const sl_explanation *e, const sl_miss *miss,
                       bool first) {
    const sl_sequence *sequence = &miss->sequence;
    const uint32_t last = sequence->directed_count - 1;
    const sl_directed_portal *directed = &space->directed[sequence->directed[last]];
    printf("%s through %" PRIu32 " portal%s into cell %" PRIu32 ", %" PRIu32
           " portal%s short of cell %" PRIu32 ":\n",
           first ? "The sequence that came farthest leads" : "Another came", last, plural(last),
           space->directed[sequence->directed[last - 1]].cell, miss->missing, plural(miss->missing),
           e->to);
    print_portals(space, sequence, last);
    printf("Portal %" PRIu32 ", which would come next, into cell %" PRIu32 ", stops it: ",
           directed->portal, directed->cell);
    if (miss->turns) {
        printf("it turns back, and no straight line crosses it and portal %" PRIu32,
               portal_of(space, sequence, sequence->ends[0].portal));
        if (sequence->end_count > 4)
            printf(" and portal %" PRIu32, portal_of(space, sequence, sequence->ends[2].portal));
        puts(" all forwards.");
        return;
    }
    printf("a line would have to keep ");
    print_ends(space, sequence, true);
    printf(" at its left and ");
    print_ends(space, sequence, false);
    printf(" at its right; but %s.\n", sl_sequence_reason(space, sequence));
}

static void print_hidden(const sl_space *space, const sl_explanation *e) {
    if (e->complete)
        printf("Cell %" PRIu32 " does not see cell %" PRIu32
               ": no sequence of portals between them has a sightline (%" PRIu64
               " stabbing test%s).\n",
               e->from, e->to, e->tests, plural(e->tests));
    else
        printf("Whether cell %" PRIu32 " sees cell %" PRIu32 " is not known after %" PRIu64
               " stabbing test%s: no sightline has been found.\n",
               e->from, e->to, e->tests, plural(e->tests));
    for (uint32_t i = 0; i < e->miss_count; i++) print_miss(space, e, &e->misses[i], i == 0);
}

// --- the file

/// Why the file says something else.
static void print_difference(const sl_explained *a) {
    const sl_baked *baked = a->baked;
    const sl_explanation *e = &a->e.now;
    const char *truth = e->seen ? "seen" : "hidden";
    switch (baked->visibility.guarantee) {
    case SL_ROUNDED:
        printf(sl_explained_is_doubtful(a) ? ": rounding decided that" : ", by a rounded solver");
        printf("; exactly, it is %s.\n", truth);
        return;
    case SL_CONSERVATIVE:
    case SL_AGGRESSIVE:
        printf(": its method, %s, is %s; exactly, it is %s.\n", baked->method,
               sl_guarantee_name(baked->visibility.guarantee), truth);
        return;
    case SL_EXACT:
        break;
    }
    printf(" and promises exact answers, but it is %s: the file is wrong.\n", truth);
}

static void print_file(const sl_explained *a) {
    const sl_baked *baked = a->baked;
    const sl_explanation *e = &a->e.now;
    const sl_said said = sl_explained_said(a);
    if (said == SL_SAID_NOTHING) {
        puts("The file does not say: it was baked from inside cells only.");
        return;
    }
    const char *word = said == SL_SAID_SEEN ? "seen" : "hidden";
    const sl_sight sight = baked->visibility.sight;
    if (sight != e->sight)
        printf("The file, baked with %s sight, says %s", sight_name(sight), word);
    else
        printf("The file says %s", word);
    if (sight != e->sight || (!e->complete && !e->seen))
        puts(".");
    else if ((said == SL_SAID_SEEN) != e->seen)
        print_difference(a);
    else
        puts(sl_explained_is_doubtful(a) ? " too, but rounding decided that." : " too.");
}

/// Prints a way by mirror, step by step.
static void print_steps(const sl_baked *baked, const sl_bent_sightline *bent) {
    for (uint32_t i = 0; i < bent->step_count; i++) {
        const sl_bent_step *step = &bent->steps[i];
        printf("  %2" PRIu32 "  ", i + 1);
        if (step->mirror == UINT32_MAX) {
            printf("portal %" PRIu32 " into cell %" PRIu32 "\n",
                   baked->space.directed[step->directed].portal, step->cell);
            continue;
        }
        const sl_segment at = baked->map.mirrors[step->mirror].segment;
        printf("mirror %" PRIu32 " from ", step->mirror);
        print_point(at.a);
        printf(" to ");
        print_point(at.b);
        printf(", back into cell %" PRIu32 "\n", step->cell);
    }
    const int digits = sl_map_digits(&baked->map);
    printf("The line starts about ");
    for (uint32_t i = 0; i < bent->mirrors + 2; i++) {
        const sl_point p = bent->bends[i];
        printf("%s(%.*g,%.*g)",
               !i                   ? ""
               : i <= bent->mirrors ? ", bends at "
                                    : " and ends about ",
               digits, p.x, digits, p.y);
    }
    puts(bent->rounded ? "; places in mirrors are rounded." : ".");
}

// --- effects

static void print_names(const sl_map *map, const bool *marked) {
    size_t count = 0, printed = 0;
    for (size_t i = 0; i < map->door_count; i++) count += sl_door_is_first(map, marked, i);
    for (size_t i = 0; i < map->door_count; i++) {
        if (!sl_door_is_first(map, marked, i)) continue;
        printf("%s%s", !printed ? "" : printed + 1 < count ? ", " : " and ", map->doors[i].name);
        printed++;
    }
}

/// Which doors the pair needs, by the file: "west, or north-west and east".
static void print_needs(const sl_explained *a, bool mirrored, bool *scratch) {
    const sl_visibility *v = &a->baked->visibility;
    const sl_door_sets *sets = mirrored ? &v->mirrored_doors : &v->doors;
    const sl_explanation *e = &a->e.now;
    const sl_map *map = &a->baked->map;
    uint32_t count = 0;
    while (sl_door_sets_alternative(sets, e->from, e->to, count, NULL)) count++;
    if (count < 2) return;
    printf("It is seen while the doors are open ");
    for (uint32_t i = 0; i < count; i++) {
        for (size_t k = 0; k < map->door_count; k++) scratch[k] = false;
        sl_door_sets_alternative(sets, e->from, e->to, i, scratch);
        if (i) printf(", or ");
        print_names(map, scratch);
    }
    puts(".");
}

/// Prints what of effects a way passes: open doors, glass from its lit side, its length.
static void print_passed(const sl_explained *a, const sl_way *w, bool *scratch) {
    const sl_map *map = &a->baked->map;
    if (sl_way_doors(a, w, false, scratch)) {
        printf("It passes the open doors ");
        print_names(map, scratch);
        puts(".");
    }
    print_needs(a, w->bent != NULL, scratch);
    for (uint32_t i = 0; i < sl_way_count(w); i++) {
        const sl_seam *glass = sl_way_seam(&a->baked->space, w, i, SL_SEAM_ONEWAY);
        if (!glass) continue;
        printf("It passes one-way glass from ");
        print_point(glass->at.a);
        printf(" to ");
        print_point(glass->at.b);
        puts(", which is seen through from this side.");
    }
    if (map->range > 0 && sl_way_count(w) > 1)
        printf("The shortest line there is %.6g long, within the range of %.6g.\n", w->length,
               map->range);
}

/// The effects that can hide a pair.
enum { HIDING = 3 };
static const struct {
    unsigned bit;
    const char *what;
} hiding[HIDING] = {{SL_EFFECT_DOOR, "shut doors"},
                    {SL_EFFECT_ONEWAY, "one-way glass"},
                    {SL_EFFECT_RANGE, "the view range"}};

static void print_effects(unsigned effects, const char *last) {
    unsigned count = 0, printed = 0;
    for (size_t i = 0; i < HIDING; i++) count += !!(effects & hiding[i].bit);
    for (size_t i = 0; i < HIDING; i++) {
        if (!(effects & hiding[i].bit)) continue;
        printf("%s%s", !printed ? "" : printed + 1 < count ? ", " : last, hiding[i].what);
        printed++;
    }
}

/// Prints what stops a way that effects hide.
static void print_stops(const sl_explained *a, const sl_way *w, bool *scratch) {
    const sl_map *map = &a->baked->map;
    if (sl_way_doors(a, w, true, scratch)) {
        printf("Shut on this way: ");
        print_names(map, scratch);
        puts(".");
    }
    for (uint32_t i = 0; i < sl_way_count(w); i++) {
        if (!sl_way_is_dark(a, w, i)) continue;
        const sl_seam *glass = sl_way_seam(&a->baked->space, w, i, SL_SEAM_ONEWAY);
        printf("Dark from this side: one-way glass from ");
        print_point(glass->at.a);
        printf(" to ");
        print_point(glass->at.b);
        puts(".");
    }
    if (map->range > 0 && w->length > map->range)
        printf("Too far: the shortest line there is %.6g long, the range is %.6g.\n", w->length,
               map->range);
}

/// "Without shut doors, or without the view range, the cell would be seen."
static void print_verdict(const sl_explained *a, const sl_effect_verdict *verdict, bool mirrored) {
    if (verdict->seen || !a->e.effects) return;
    const char *by = mirrored ? "By mirror, walls" : "Walls";
    if (!verdict->without) {
        printf("%s hide it with or without ", by);
        print_effects(a->e.effects, " and ");
        puts(a->e.complete ? "." : ", as far as was searched.");
        return;
    }
    printf(mirrored ? "By mirror, without " : "Without ");
    print_effects(verdict->decides ? verdict->decides : verdict->without,
                  verdict->decides ? ", or without " : " and ");
    puts(verdict->decides ? ", the cell would be seen."
                          : " together, the cell would be seen; none of them decides alone.");
}

static void print_would_be(const sl_explained *a, bool *scratch) {
    const sl_explanation *e = &a->e.without;
    const sl_space *space = &a->baked->space;
    const sl_way w = sl_way_direct(e);
    printf("Without ");
    print_effects(a->e.direct.without, " and ");
    printf(" it is seen through %" PRIu32 " portal%s:\n", sl_way_count(&w),
           plural(sl_way_count(&w)));
    print_portals(space, &e->sequence, sl_way_count(&w));
    print_line(e->witness);
    puts(e->verdict == SL_GRAZING ? " grazes there." : " passes there.");
    print_stops(a, &w, scratch);
}

static void print_bent(const sl_explained *a, bool *scratch) {
    const sl_explanation *e = &a->e.now;
    const sl_bent_sightline *bent = &e->bent;
    const bool hidden = !a->e.mirrored.seen;
    if (bent->verdict != SL_HIDDEN) {
        printf("By mirror cell %" PRIu32 " sees cell %" PRIu32 "%s, with %" PRIu32
               " reflection%s:\n",
               e->from, e->to, bent->verdict == SL_GRAZING ? ", though lines only graze" : "",
               bent->mirrors, plural(bent->mirrors));
        print_steps(a->baked, bent);
        const sl_way w = sl_way_bent(bent);
        print_passed(a, &w, scratch);
    }
    if (!hidden) return;
    if (bent->verdict == SL_HIDDEN)
        printf("By mirror it is not seen%s.\n",
               bent->complete ? "" : ", as far as the tests went that --tests allows");
    print_verdict(a, &a->e.mirrored, true);
    if (!a->e.bent_without.step_count) return;
    printf("Without ");
    print_effects(a->e.mirrored.without, " and ");
    printf(" it is seen with %" PRIu32 " reflection%s:\n", a->e.bent_without.mirrors,
           plural(a->e.bent_without.mirrors));
    print_steps(a->baked, &a->e.bent_without);
    const sl_way w = sl_way_bent(&a->e.bent_without);
    print_stops(a, &w, scratch);
}

static void print_now(const sl_explained *a) {
    const sl_explanation *e = &a->e.now;
    const sl_space *space = &a->baked->space;
    if (e->from == e->to)
        printf("Cell %" PRIu32 " sees itself: it is convex, and no wall is inside it.\n", e->from);
    else if (e->distance == SL_NO_WAY)
        printf("Cell %" PRIu32 " does not see cell %" PRIu32
               ": no portals lead from one to the other.\n",
               e->from, e->to);
    else if (e->sequence.directed_count == 1)
        printf("Cell %" PRIu32 " sees cell %" PRIu32 ": they share portal %" PRIu32 ".\n", e->from,
               e->to, portal_of(space, &e->sequence, 0));
    else if (e->verdict == SL_STABBED)
        print_stabbed(space, e);
    else if (e->verdict == SL_GRAZING)
        print_grazing(space, e);
    else
        print_hidden(space, e);
}

void explanation_print(const sl_explained *a, bool *scratch) {
    const sl_explanation *e = &a->e.now;
    print_now(a);
    const sl_way w = sl_way_direct(e);
    if (e->seen && e->from != e->to) print_passed(a, &w, scratch);
    print_verdict(a, &a->e.direct, false);
    if (a->e.direct.without) print_would_be(a, scratch);
    print_file(a);
    if (e->bent.asked) print_bent(a, scratch);
}
