/// `sightline explain`: why a cell does or does not see another.
#include "commands.h"
#include "inputs.h"
#include "json_print.h"
#include "names.h"
#include "options.h"
#include "outputs.h"
#include "sightline/bake.h"
#include "sightline/draw.h"
#include "sightline/explain.h"
#include "sightline/support.h"

#include <inttypes.h>
#include <string.h>

// --- text

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

typedef enum said { SAID_NOTHING, SAID_HIDDEN, SAID_SEEN } said;

/// What the file says about the pair. Nothing where the bake did not look from the cell.
static said said_by(const sl_baked *baked, const sl_explanation *e) {
    const sl_pvs *pvs = &baked->visibility.pvs;
    if (!sl_pvs_count(pvs, e->from)) return SAID_NOTHING;
    return sl_pvs_sees(pvs, e->from, e->to) ? SAID_SEEN : SAID_HIDDEN;
}

static bool is_doubtful(const sl_baked *baked, const sl_explanation *e) {
    const sl_pvs *doubtful = &baked->visibility.doubtful;
    return doubtful->cell_count && sl_pvs_sees(doubtful, e->from, e->to);
}

/// Why the file says something else.
static void print_difference(const sl_baked *baked, const sl_explanation *e) {
    const char *truth = e->seen ? "seen" : "hidden";
    switch (baked->visibility.guarantee) {
    case SL_ROUNDED:
        printf(is_doubtful(baked, e) ? ": rounding decided that" : ", by a rounded solver");
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

static void print_file(const sl_baked *baked, const sl_explanation *e) {
    const said what = said_by(baked, e);
    if (what == SAID_NOTHING) {
        puts("The file does not say: it was baked from inside cells only.");
        return;
    }
    const char *word = what == SAID_SEEN ? "seen" : "hidden";
    const sl_sight sight = baked->visibility.sight;
    if (sight != e->sight)
        printf("The file, baked with %s sight, says %s", sight_name(sight), word);
    else
        printf("The file says %s", word);
    if (sight != e->sight || (!e->complete && !e->seen))
        puts(".");
    else if ((what == SAID_SEEN) != e->seen)
        print_difference(baked, e);
    else
        puts(is_doubtful(baked, e) ? " too, but rounding decided that." : " too.");
}

/// By mirror, step by step.
static void print_bent(const sl_baked *baked, const sl_explanation *e) {
    const sl_bent_sightline *bent = &e->bent;
    if (bent->verdict == SL_HIDDEN) {
        printf("By mirror it is not seen%s.\n",
               bent->complete ? "" : ", as far as the tests went that --tests allows");
        return;
    }
    printf("By mirror cell %" PRIu32 " sees cell %" PRIu32 "%s, with %" PRIu32 " reflection%s:\n",
           e->from, e->to, bent->verdict == SL_GRAZING ? ", though lines only graze" : "",
           bent->mirrors, plural(bent->mirrors));
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
    printf("The line starts about ");
    for (uint32_t i = 0; i < bent->mirrors + 2; i++) {
        const sl_point p = bent->bends[i];
        printf("%s(%.6g,%.6g)",
               !i                   ? ""
               : i <= bent->mirrors ? ", bends at "
                                    : " and ends about ",
               p.x, p.y);
    }
    puts(bent->rounded ? "; places in mirrors are rounded." : ".");
}

static void explanation_print(const sl_baked *baked, const sl_explanation *e) {
    const sl_space *space = &baked->space;
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
    print_file(baked, e);
    if (e->bent.asked) print_bent(baked, e);
}

// --- JSON

static void add_segment(json_fields *fields, const char *key, sl_point a, sl_point b) {
    json_add_box(fields, key, (sl_box){a, b});
}

static void put_portal(sl_json_writer *json, const sl_directed_portal *directed) {
    sl_json_put_object(json);
    sl_json_put_key(json, "portal");
    sl_json_put_integer(json, directed->portal);
    sl_json_put_key(json, "cell");
    sl_json_put_integer(json, directed->cell);
    sl_json_put_key(json, "left");
    json_put_point(json, directed->left);
    sl_json_put_key(json, "right");
    json_put_point(json, directed->right);
    sl_json_put_end(json, '}');
}

static void put_portals(sl_json_writer *json, const sl_space *space, const sl_sequence *sequence,
                        uint32_t count) {
    sl_json_put_list(json);
    for (uint32_t i = 0; i < count; i++) put_portal(json, &space->directed[sequence->directed[i]]);
    sl_json_put_end(json, ']');
}

static void put_ends(sl_json_writer *json, const sl_space *space, const sl_sequence *sequence) {
    sl_json_put_list(json);
    for (uint32_t i = 0; i < sequence->end_count; i++) {
        const sl_stab_end end = sequence->ends[i];
        sl_json_put_object(json);
        sl_json_put_key(json, "portal");
        sl_json_put_integer(json, portal_of(space, sequence, end.portal));
        sl_json_put_key(json, "side");
        sl_json_put_text(json, end.left ? "left" : "right");
        sl_json_put_key(json, "point");
        json_put_point(json, sl_sequence_end(space, sequence, end));
        sl_json_put_end(json, '}');
    }
    sl_json_put_end(json, ']');
}

static void put_miss(sl_json_writer *json, const sl_space *space, const sl_miss *miss) {
    const uint32_t last = miss->sequence.directed_count - 1;
    sl_json_put_object(json);
    sl_json_put_key(json, "sequence");
    put_portals(json, space, &miss->sequence, last);
    sl_json_put_key(json, "stopped_by");
    put_portal(json, &space->directed[miss->sequence.directed[last]]);
    sl_json_put_key(json, "reason");
    sl_json_put_text(json, miss->turns ? "turn" : "conflict");
    sl_json_put_key(json, "missing");
    sl_json_put_integer(json, (int64_t)miss->missing);
    sl_json_put_key(json, "ends");
    put_ends(json, space, &miss->sequence);
    sl_json_put_end(json, '}');
}

static void add_file(json_fields *fields, const sl_baked *baked, const sl_explanation *e) {
    const said what = said_by(baked, e);
    json_fields inner = json_begin();
    json_add_text(&inner, "sight", sight_name(baked->visibility.sight));
    json_add_text(&inner, "method", baked->method);
    json_add_text(&inner, "guarantee", sl_guarantee_name(baked->visibility.guarantee));
    if (what == SAID_NOTHING)
        json_add_text(&inner, "seen", NULL);
    else
        json_add_flag(&inner, "seen", what == SAID_SEEN);
    json_add_flag(&inner, "doubtful", is_doubtful(baked, e));
    json_add_fields(fields, "file", &inner);
}

static void add_found(json_fields *fields, const sl_space *space, const sl_explanation *e) {
    if (!e->sequence.directed_count) return;
    put_portals(json_add(fields, "sequence"), space, &e->sequence, e->sequence.directed_count);
    add_segment(fields, "line", e->witness.a, e->witness.b);
    json_add_flag(fields, "touches", e->touches);
    add_segment(fields, "shown", e->shown.a, e->shown.b);
    if (e->verdict == SL_GRAZING) put_ends(json_add(fields, "ends"), space, &e->sequence);
}

static void add_bent(json_fields *fields, const sl_space *space, const sl_bent_sightline *bent,
                     const char *verdict) {
    json_fields inner = json_begin();
    json_add_text(&inner, "verdict", verdict);
    json_add_flag(&inner, "complete", bent->complete);
    json_add_count(&inner, "tests", bent->tests);
    json_add_flag(&inner, "rounded", bent->rounded);
    json_add_count(&inner, "mirrors", bent->mirrors);
    sl_json_writer *json = json_add(&inner, "steps");
    sl_json_put_list(json);
    for (uint32_t i = 0; i < bent->step_count; i++) {
        const sl_bent_step *step = &bent->steps[i];
        const bool portal = step->mirror == UINT32_MAX;
        sl_json_put_object(json);
        sl_json_put_key(json, portal ? "portal" : "mirror");
        sl_json_put_integer(json, portal ? space->directed[step->directed].portal : step->mirror);
        sl_json_put_key(json, "cell");
        sl_json_put_integer(json, step->cell);
        sl_json_put_end(json, '}');
    }
    sl_json_put_end(json, ']');
    json_add_points(&inner, "line", bent->bends, bent->bends ? bent->mirrors + 2 : 0);
    json_add_fields(fields, "by_mirror", &inner);
}

static sl_status explanation_print_json(sl_context *context, const sl_baked *baked,
                                        const sl_explanation *e) {
    static const char *const verdicts[] = {
        [SL_HIDDEN] = "hidden", [SL_GRAZING] = "grazing", [SL_STABBED] = "stabbed"};
    json_fields fields = json_begin();
    json_add_count(&fields, "from", e->from);
    json_add_count(&fields, "to", e->to);
    json_add_text(&fields, "sight", sight_name(e->sight));
    json_add_flag(&fields, "seen", e->seen);
    json_add_text(&fields, "verdict", verdicts[e->verdict]);
    json_add_flag(&fields, "complete", e->complete);
    json_add_count(&fields, "tests", e->tests);
    if (e->distance == SL_NO_WAY)
        json_add_text(&fields, "distance", NULL);
    else
        json_add_count(&fields, "distance", e->distance);
    add_found(&fields, &baked->space, e);
    sl_json_writer *misses = json_add(&fields, "misses");
    sl_json_put_list(misses);
    for (uint32_t i = 0; i < e->miss_count; i++) put_miss(misses, &baked->space, &e->misses[i]);
    sl_json_put_end(misses, ']');
    add_file(&fields, baked, e);
    if (e->bent.asked) add_bent(&fields, &baked->space, &e->bent, verdicts[e->bent.verdict]);
    return json_print(context, &fields);
}

// --- the command

typedef struct explain_plan {
    const char *operands[3], *output;
    sl_explain_options options;
    const char *sight_given; ///< else sight is as the file was baked
    uint32_t mirror_depth;
    sl_draw_options drawing;
    bool json;
} explain_plan;

enum { FILE_OPERAND, FROM_OPERAND, TO_OPERAND };

/// A cell by its number or by a point in it.
static sl_status choose_cell(sl_context *context, const char *name, const char *text,
                             const sl_space *space, uint32_t *cell) {
    if (!strchr(text, ',')) {
        uint64_t number = 0;
        if (read_count(context, name, text, space->cell_count - 1, &number) != SL_OK)
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "%s %s: a cell from 0 to %u, or a point X,Y, is needed", name, text,
                           (unsigned)space->cell_count - 1);
        *cell = (uint32_t)number;
        if (!space->cells[*cell].solid) return SL_OK;
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "%s %s: the cell is solid ground; choose a cell in a room", name, text);
    }
    sl_point at = {0};
    SL_TRY(read_point(context, name, text, &at));
    return input_locate(context, name, text, space, at, cell);
}

static sl_status explain(command_console *console, const explain_plan *plan,
                         const sl_baked *baked) {
    sl_context *context = console->context;
    const sl_space *space = &baked->space;
    sl_explain_options options = plan->options;
    uint32_t from, to;
    if (!plan->sight_given) options.sight = baked->visibility.sight;
    SL_TRY(choose_cell(context, "A", plan->operands[FROM_OPERAND], space, &from));
    SL_TRY(choose_cell(context, "B", plan->operands[TO_OPERAND], space, &to));
    sl_explanation explanation;
    SL_TRY(sl_explain(context, space, &options, from, to, &explanation));
    sl_status status = SL_OK;
    if (baked->map.mirror_count)
        status = sl_explain_by_mirror(context, space, &baked->map, &options, plan->mirror_depth,
                                      &explanation);
    if (status == SL_OK && plan->output)
        status = sl_draw_explanation(context, baked, &explanation, &plan->drawing, plan->output);
    progress_line_clear(&console->line);
    if (status == SL_OK && plan->json)
        status = explanation_print_json(context, baked, &explanation);
    else if (status == SL_OK)
        explanation_print(baked, &explanation);
    sl_explanation_destroy(context, &explanation);
    return status;
}

sl_status cmd_explain(command_console *console, int argc, char **argv) {
    explain_plan plan = {.options = sl_explain_options_default(),
                         .mirror_depth = 1,
                         .drawing = sl_draw_options_default()};
    const option_table picture = picture_option_table(&plan.drawing, false);
    const option_spec options[] = {
        {"sight", 0, "closed|open",
         "whether lines count that touch portal ends;\nwithout it, as the file was baked",
         .sight = &plan.options.sight, .given = &plan.sight_given},
        {"misses", 0, "N",
         "of a hidden pair, how many sequences to tell of\nthat came far; 3 without it",
         .count32 = &plan.options.most_misses},
        {"tests", 0, "N", "give up after N stabbing tests, and tell what is known",
         .count = &plan.options.most_tests},
        {"mirror-depth", 0, "N", "how often mirrors reflect a sightline, 0 to 16;\n1 without it",
         .count32 = &plan.mirror_depth, .most = 16},
        {"output", 'o', "PICTURE", "draw it too: .png, .svg or .pdf, by the ending",
         .text = &plan.output, .check = CHECK_PICTURE},
        {.group = &picture},
        {"json", 0, NULL, "print JSON", .flag = &plan.json},
    };
    const command_usage usage = {
        .name = "explain",
        .synopsis = "FILE.slv A B [options]",
        .operands = {"FILE.slv", "A", "B"},
        .what = "Tells why cell A does or does not see cell B: a line and the portals that it "
                "passes, or\nwhat stops the sequences of portals that come farthest. Exact, "
                "whatever the file's solver.\nA and B are numbers of cells, or points X,Y in them "
                "(after -- where X is negative).",
        .examples = "  sightline explain office.slv 12 40\n"
                    "  sightline explain office.slv 53,20 3.5,2 -o why.png",
        .options = options,
        .option_count = sizeof options / sizeof *options,
    };
    bool helped;
    SL_TRY(options_parse(console, &usage, argc, argv, plan.operands, &helped));
    if (helped) return SL_OK;
    sl_baked baked = {0};
    SL_TRY(input_read_baked(console->context, plan.operands[FILE_OPERAND], &baked));
    sl_status status = sl_effects_check(console->context, &baked.map, "explain", SL_EFFECT_MIRROR);
    if (status == SL_OK) status = explain(console, &plan, &baked);
    sl_baked_destroy(console->context, &baked);
    return status;
}
