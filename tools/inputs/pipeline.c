/// A map is read, cleaned and subdivided; and what is said on the way, with the next step.
#include "inputs/pipeline.h"

#include "arguments/help.h"
#include "inputs/inputs.h"
#include "sightline/effects.h"
#include "sightline/faults.h"
#include "sightline/support.h"
#include "system/built.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const kd_rules[] = {"spanning", "obscured", "cleaving", "median"};
enum { SPANNING = 1, OBSCURED = 2, CLEAVING = 4, MEDIAN = 8, ALL_RULES = 15 };
static const name_table kd_rule_names = {"rule", kd_rules, sizeof *kd_rules, 4, NULL};

/// The longest that say_map() says, its 0 included; longer ones are cut.
enum { SAID = 1024 };

/// So small a share of the area is walls that are drawn as outlines, and no room.
static const double FEW_INSIDE = 0.1;

/// Such a share of the area inside, in rooms without an opening, is worth a word. Less may be
/// courts and shafts.
static const double SEALED = 0.25;
/// The same where an entrance is given: how wide its openings are is no doubt then.
static const double SEALED_BY_WIDTH = 0.1;

/// The least share of a game's map inside, not joined to the largest part, that gets a note.
static const double APART = 0.01;
/// From such a share on, a part that does not reach the edge is rooms with rock around them. Less
/// may be a house in a field, or a pocket.
static const double ROOMS = 0.1;

// --- options

map_pipeline pipeline_default(void) {
    return (map_pipeline){
        .input = input_options_default(), .bake = sl_bake_options_default(), .kd_rules = ALL_RULES};
}

option_table pipeline_without_table(map_pipeline *p) {
    const option_spec without = {"without",
                                 0,
                                 "EFFECT,...",
                                 "ignore effects of the map: door, mirror, oneway, range",
                                 .choices = &p->without,
                                 .names = effect_table(),
                                 .rare = true};
    option_table table = {0};
    option_table_add(&table, &without, 1);
    option_table_topic(&table, "reading a map");
    return table;
}

/// Options that change how the map is cut into cells.
static option_table cutting_option_table(map_pipeline *p) {
    const option_spec options[] = {
        {"subdivide", 0, "kd|mesh|given",
         "how to cut the map into cells (default: given if the map brings cells, kd if all walls "
         "are axial, else mesh)",
         .choice = &p->subdivide, .names = subdivision_table(), .text = &p->subdivide_text},
        {"kd-rules", 0, "RULE,...",
         "rules of the kd-tree to use: spanning, obscured, cleaving, median (default: all)",
         .choices = &p->kd_rules, .names = kd_rule_names, .given = &p->kd_rules_given},
        {"kd-obscured", 0, "SHARE",
         "the rule 'obscured' prefers lines of which walls cover this share, 0 to 1",
         .number = &p->bake.rules.obscured, .most = 1, .needs = "a share from 0 to 1 is needed",
         .given = &p->kd_obscured_given},
        {"check", 0, NULL, "check the graph of cells and portals (a mesh is always checked)",
         .flag = &p->bake.check},
    };
    option_table table = {0};
    option_table_add(&table, options, sizeof options / sizeof *options);
    option_table_topic(&table, "cutting it into cells");
    for (size_t i = 0; i < table.count; i++) table.items[i].rare = true;
    return table;
}

option_table pipeline_option_table(map_pipeline *p) {
    const option_spec start = {"start",
                               0,
                               "X,Y",
                               "add a start: inside is all that starts reach",
                               .point = &p->start,
                               .text = &p->start_text,
                               .topic = "reading a map"};
    const option_spec stops = {"stops",
                               0,
                               "sight|steps|sound",
                               p->channel == SL_STOPS_STEPS
                                   ? "which walls count: those that stop WHAT (default: steps)"
                                   : "which walls count: those that stop WHAT (default: sight)",
                               .choice = &p->stops,
                               .names = stops_table(),
                               .text = &p->stops_text,
                               .topic = "reading a map",
                               .rare = true};
    const option_table input = input_option_table(&p->input), without = pipeline_without_table(p),
                       cutting = cutting_option_table(p);
    option_table table = {0};
    option_table_add(&table, input.items, input.count);
    option_table_add(&table, &start, 1);
    option_table_add(&table, &stops, 1);
    option_table_add(&table, without.items, without.count);
    option_table_add(&table, cutting.items, cutting.count);
    return table;
}

sl_status pipeline_plan(sl_context *context, const char *path, map_pipeline *p) {
    size_t count;
    const sl_subdivision *chosen = &sl_subdivisions(&count)[p->subdivide];
    const bool kd_wanted = p->kd_rules_given || p->kd_obscured_given;
    sl_subdivide_options *rules = &p->bake.rules;
    p->path = path;
    p->bake.clean = p->input.clean;
    if (p->kd_obscured_given && !(p->kd_rules & OBSCURED))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--kd-obscured needs the rule 'obscured', which --kd-rules leaves out");
    if (!(p->kd_rules & SPANNING)) rules->spanning = false;
    if (!(p->kd_rules & OBSCURED)) rules->obscured = 0;
    if (!(p->kd_rules & CLEAVING)) rules->cleaving = false;
    if (!(p->kd_rules & MEDIAN)) rules->median = false;
    if (!chosen->takes_rules && kd_wanted)
        return sl_fail(context, SL_BAD_ARGUMENT, "--%s is for --subdivide kd, not %s",
                       p->kd_rules_given ? p->kd_rules_given : p->kd_obscured_given,
                       p->subdivide_text);
    if (p->subdivide_text || kd_wanted) p->bake.subdivision = chosen;
    p->input.import.cells = p->subdivide_text && chosen->takes_cells;
#ifndef NDEBUG
    p->bake.check = true;
#endif
    return SL_OK;
}

void pipeline_take_drawn_doors(sl_context *context, map_pipeline *p) {
    if (input_is_drawing(context, p->path)) p->input.import.doors = true;
}

// --- commands to run next

/// Puts a text at a place of a longer one, as far as it has room. Returns the place after it.
static size_t put(char *text, size_t size, size_t at, const char *part) {
    const int length = at < size ? snprintf(text + at, size - at, "%s", part) : (int)strlen(part);
    return at + (size_t)length;
}

size_t pipeline_shell_word(const char *word, char *text, size_t size) {
    const char *plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./,:=@%";
    const char *quote = !word[0] || word[strspn(word, plain)] ? "'" : "";
    size_t length = put(text, size, 0, quote);
    for (; *word; word++) {
        const char letter[2] = {*word, '\0'};
        length = put(text, size, length, *word == '\'' ? "'\\''" : letter);
    }
    return put(text, size, length, quote);
}

/// Adds a word, with what stands before it, to a command.
static void say(char text[SAID], const char *before, const char *word) {
    const size_t used = strlen(text);
    snprintf(text + used, SAID - used, "%s", before);
    const size_t now = strlen(text);
    if (word) pipeline_shell_word(word, text + now, SAID - now);
}

/// The map's file, and those options of a table that were given.
static const char *say_map(const map_pipeline *pipeline, const option_table *known,
                           char text[SAID]) {
    *text = '\0';
    say(text, pipeline->path[0] == '-' && pipeline->path[1] ? "./" : "", pipeline->path);
    for (size_t i = 0; i < pipeline->given.count; i++) {
        const struct option_given *given = &pipeline->given.items[i];
        size_t k = 0;
        while (k < known->count && strcmp(known->items[k].name, given->name) != 0) k++;
        if (k == known->count) continue;
        say(text, " --", given->name);
        if (given->argument) say(text, " ", given->argument);
    }
    return text;
}

// --- the way

static sl_status fail_start(sl_context *context, const map_pipeline *pipeline, const sl_map *map) {
    char text[SAID];
    input_options any = input_options_default();
    const option_table reading = input_option_table(&any);
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "--start %s: outside the map%s%s; to see its bounds, run: sightline info %s",
                   pipeline->start_text, *map->unit ? ", whose lengths are in " : "", map->unit,
                   say_map(pipeline, &reading, text));
}

static sl_status add_start(sl_context *context, const map_pipeline *pipeline, sl_map *map) {
    if (!pipeline->start_text) return SL_OK;
    const sl_point at = pipeline->start;
    const sl_box b = sl_map_bounds(map);
    if (at.x < b.min.x || at.x > b.max.x || at.y < b.min.y || at.y > b.max.y)
        return fail_start(context, pipeline, map);
    return sl_map_add_start(context, map, at, 0, 0);
}

sl_status pipeline_prepare(sl_context *context, const map_pipeline *pipeline, sl_map *map) {
    if (pipeline->bake.subdivision && !pipeline->bake.subdivision->takes_cells)
        sl_map_drop_cells(context, map);
    SL_TRY(add_start(context, pipeline, map));
    if (pipeline->stops_text)
        map->channel = UINT32_C(1) << pipeline->stops;
    else if (pipeline->channel)
        map->channel = pipeline->channel;
    input_note_limited(context, map);
    sl_effects_leave_out(context, map, pipeline->without);
    return pipeline->settles_doors ? sl_effects_settle_doors(context, map) : SL_OK;
}

sl_status pipeline_read(sl_context *context, const map_pipeline *pipeline, sl_map *map) {
    SL_TRY(input_read_map(context, pipeline->path, &pipeline->input, map));
    return pipeline_prepare(context, pipeline, map);
}

sl_status pipeline_read_clean(sl_context *context, const map_pipeline *pipeline, sl_map *map,
                              sl_clean_account *account) {
    SL_TRY(pipeline_read(context, pipeline, map));
    return pipeline_clean(context, pipeline, map, account);
}

sl_status pipeline_clean(sl_context *context, const map_pipeline *pipeline, sl_map *map,
                         sl_clean_account *account) {
    const sl_clean_options *clean = &pipeline->input.clean;
    SL_TRY(sl_map_clean(context, map, clean, account));
    return sl_map_find_inside(context, map, clean, account);
}

sl_status pipeline_subdivide(sl_context *context, const map_pipeline *pipeline, const sl_map *map,
                             sl_space *space) {
    const sl_bake_options *bake = &pipeline->bake;
    const sl_subdivision *way = bake->subdivision ? bake->subdivision : sl_subdivision_for(map);
    SL_TRY(way->subdivide(context, map, &bake->rules, space));
    return bake->check || space->neighbour ? sl_space_check(context, space) : SL_OK;
}

/// Reads a file into one of the two; *is_baked says which one.
static sl_status read_map_or_baked(sl_context *context, const map_pipeline *pipeline, sl_map *map,
                                   sl_baked *baked, bool *is_baked) {
    sl_bytes bytes;
    const input_options *input = &pipeline->input;
    const char *path = pipeline->path;
    sl_context_set_limits(context, &input->limits);
    SL_TRY(sl_file_read(context, path, &bytes));
    *is_baked = input_is_baked(path, &bytes);
    sl_status status = *is_baked ? input_refuse_options(context, path, input) : SL_OK;
    if (status == SL_OK && *is_baked && pipeline->stops_text)
        status = sl_fail(context, SL_BAD_ARGUMENT,
                         "--stops: %s is baked; the option is for reading a map", path);
    if (status == SL_OK && *is_baked)
        status = input_parse_baked(context, path, &bytes, baked);
    else if (status == SL_OK)
        status = sl_map_parse(context, path, bytes.data, bytes.size, &input->import, map);
    sl_free(context, bytes.data);
    return status;
}

sl_status pipeline_read_space(sl_context *context, const map_pipeline *pipeline, const char *user,
                              unsigned effects, const char *reason, sl_baked *baked) {
    bool is_baked;
    sl_map map = {0};
    sl_bake_options options = pipeline->bake;
    sl_bake_account account = {0};
    SL_TRY(read_map_or_baked(context, pipeline, &map, baked, &is_baked));
    if (is_baked) return sl_effects_check(context, &baked->map, user, effects, reason);
    sl_status status = pipeline_prepare(context, pipeline, &map);
    if (status == SL_OK) status = sl_effects_check(context, &map, user, effects, reason);
    if (status == SL_OK) status = sl_bake_space(context, &map, &options, baked, &account);
    sl_map_destroy(context, &map);
    return status;
}

/// The map with its walls, which baking moves to the space. Nothing of it is its own.
static sl_map with_walls(const sl_map *map, const sl_space *space) {
    sl_map whole = *map;
    if (!whole.wall_count) {
        whole.walls = space->walls;
        whole.wall_count = space->wall_count;
    }
    return whole;
}

/// The digits of places in the map.
static int digits_of(const sl_map *map, const sl_space *space) {
    const sl_map whole = with_walls(map, space);
    return sl_map_digits(&whole);
}

/// Whether a game's map was read, by its file's name. Files of several kinds are called .json:
/// those of games count y down.
static bool is_game(const sl_context *context, const map_pipeline *pipeline, const sl_map *map) {
    return input_is_game(context, pipeline->path) && map->source.transform.y_down;
}

/// What is inside with a width of entrances: whether a building is, and with `share` which share of
/// the area; 0 where no part is inside by it.
static sl_status try_entrance(sl_context *context, const map_pipeline *pipeline,
                              const sl_map *whole, double width, bool *building, double *share) {
    sl_map map = {0};
    sl_space space = {0};
    char text[SL_NUMBER_TEXT];
    snprintf(text, sizeof text, "%.4g", width); // as it is printed
    sl_status status = sl_map_copy(context, whole, &map);
    map.entrance = strtod(text, NULL);
    map.entrance_by_doors = false;
    if (status == SL_OK) status = sl_map_find_inside(context, &map, &pipeline->input.clean, NULL);
    const bool any = status == SL_OK && map.interior.place_count;
    *building = any && map.interior.building;
    if (share) *share = 0;
    if (share && any) status = pipeline_subdivide(context, pipeline, &map, &space);
    if (share && any && status == SL_OK) *share = sl_space_ground(&space).inside;
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    return status;
}

sl_status pipeline_decide_opening(sl_context *context, const map_pipeline *pipeline,
                                  const sl_map *map, const sl_space *space, doubtful_opening *out) {
    const double widths[2] = {map->interior.doubtful_width, map->interior.width};
    const sl_map whole = with_walls(map, space);
    bool building = is_game(context, pipeline, map);
    *out = (doubtful_opening){.start = building, .wide = true, .entrance = widths[0]};
    for (int i = 0; i < 2 && !building; i++) {
        SL_TRY(try_entrance(context, pipeline, &whole, widths[i], &building, NULL));
        if (building) *out = (doubtful_opening){.wide = i == 0, .entrance = widths[i]};
    }
    return SL_OK;
}

sl_status pipeline_share_by_entrance(sl_context *context, const map_pipeline *pipeline,
                                     const sl_map *map, const sl_space *space, double width,
                                     double *share) {
    const sl_map whole = with_walls(map, space);
    bool building;
    return try_entrance(context, pipeline, &whole, width, &building, share);
}

/// Refuses a map with an opening in doubt. A start behind it would lead out of a house, and a start
/// in a closed part keeps no other.
static sl_status refuse_opening(sl_context *context, const map_pipeline *pipeline,
                                const sl_map *map, const sl_space *space, const char *or_else) {
    const sl_interior *found = &map->interior;
    const int digits = digits_of(map, space);
    doubtful_opening next;
    sl_point start;
    char advice[160];
    SL_TRY(pipeline_decide_opening(context, pipeline, map, space, &next));
    if (next.start) {
        SL_TRY(pipeline_likely_start(context, map, space, &start));
        snprintf(advice, sizeof advice,
                 "say where a room is, as with --start %.*g,%.*g; or if the opening is an "
                 "entrance, add --entrance %.4g",
                 digits, start.x, digits, start.y, next.entrance);
    } else {
        snprintf(advice, sizeof advice, "%s, add --entrance %.4g; else add a start in a room",
                 next.wide ? "if the opening is an entrance"
                           : "if rooms behind narrower openings are what is inside",
                 next.entrance);
    }
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "the map has no start, and an opening %.4g%s%s wide, at %.*g,%.*g, is wider "
                   "than entrances are (%.4g); %s%s",
                   found->doubtful_width, *map->unit ? " " : "", map->unit, digits,
                   found->doubtful.a.x, digits, found->doubtful.a.y, found->width, advice, or_else);
}

/// Refuses a map as pipeline_need_inside() says.
static sl_status refuse_inside(sl_context *context, const map_pipeline *pipeline, const sl_map *map,
                               const sl_space *space, const char *or_else) {
    const sl_ground_shares shares = sl_space_ground(space);
    sl_inside doubt;
    double enclosed;
    SL_TRY(sl_doubt_inside(context, map, space, &doubt));
    SL_TRY(sl_space_enclosed(context, space, &enclosed));
    if (doubt == SL_INSIDE_OPENING) return refuse_opening(context, pipeline, map, space, or_else);
    if (doubt != SL_INSIDE_SMALL || !(shares.outside > 0) || enclosed > FEW_INSIDE) return SL_OK;
    return sl_fail(
        context, SL_BAD_ARGUMENT,
        "the map has no start, and walls enclose only %.2g %% of the area among them; say "
        "where a room is with --start X,Y%s",
        100 * enclosed, or_else);
}

sl_status pipeline_likely_start(sl_context *context, const sl_map *map, const sl_space *space,
                                sl_point *start) {
    const sl_map whole = with_walls(map, space);
    sl_point roomiest;
    SL_TRY(sl_map_find_roomiest(context, &whole, &roomiest));
    const uint32_t known = sl_space_locate(space, roomiest);
    uint32_t largest = 0;
    double area = -1;
    for (uint32_t i = 0; known == SL_NO_CELL && i < space->cell_count; i++) {
        if (space->cells[i].solid || sl_space_area(space, i) <= area) continue;
        largest = i;
        area = sl_space_area(space, i);
    }
    *start = sl_space_middle(space, known == SL_NO_CELL ? largest : known);
    return SL_OK;
}

/// " --start 1,2", in a place that is likely to be right.
static sl_status say_start(sl_context *context, const sl_map *map, const sl_space *space,
                           const char *before, char text[2 * SAID]) {
    const int digits = digits_of(map, space);
    sl_point start;
    SL_TRY(pipeline_likely_start(context, map, space, &start));
    snprintf(text, 2 * SAID, "%s --start %.*g,%.*g", before, digits, start.x, digits, start.y);
    return SL_OK;
}

/// What to do next about an opening in doubt.
static sl_status say_opening(sl_context *context, const map_pipeline *pipeline, const sl_map *map,
                             const sl_space *space, const char *path, char text[2 * SAID]) {
    char command[SAID + 64];
    doubtful_opening next;
    SL_TRY(pipeline_decide_opening(context, pipeline, map, space, &next));
    snprintf(command, sizeof command, "; with a start, run: sightline check %s", path);
    if (next.start) return say_start(context, map, space, command, text);
    snprintf(text, 2 * SAID, "; %s, run: sightline check %s --entrance %.4g",
             next.wide ? "if it is one" : "if rooms behind narrower openings are what is inside",
             path, next.entrance);
    return SL_OK;
}

/// What to do next about what is inside.
static sl_status say_next(sl_context *context, const map_pipeline *pipeline, sl_inside doubt,
                          const sl_map *map, const sl_space *space, char text[2 * SAID]) {
    char path[SAID], command[SAID + 64];
    map_pipeline any = pipeline_default();
    const option_table reading = pipeline_option_table(&any);
    const size_t size = 2 * SAID;
    say_map(pipeline, &reading, path);
    switch (doubt) {
    case SL_INSIDE_SURE:
        snprintf(text, size, "; for another width, add --entrance W");
        break;
    case SL_INSIDE_LEAKS:
        snprintf(text, size, "; to see where, run: sightline check %s", path);
        break;
    case SL_INSIDE_SMALL:
        snprintf(command, sizeof command, "; add a start: sightline check %s", path);
        return say_start(context, map, space, command, text);
    case SL_INSIDE_FEW:
        snprintf(text, size, "; sightline check %s lists them, --start X,Y adds a start", path);
        break;
    case SL_INSIDE_NONE:
        snprintf(text, size, "; to see it, run: sightline check %s -o check.png", path);
        break;
    case SL_INSIDE_OPENING:
        return say_opening(context, pipeline, map, space, path, text);
    }
    return SL_OK;
}

/// Whether solid ground or starts say where rooms are.
static bool says_rooms(const sl_map *map) {
    for (size_t i = 0; i < map->wall_count; i++)
        if (map->walls[i].ground) return true;
    return map->start_count > 0;
}

/// The rock around a dungeon, the sea around an island and the inside of a crate are ground as
/// rooms are, until a start says where one walks.
static sl_status note_apart(sl_context *context, const map_pipeline *pipeline, const sl_map *map,
                            const sl_space *space) {
    char path[SAID], next[160] = "";
    map_pipeline any = pipeline_default();
    const option_table reading = pipeline_option_table(&any);
    const int digits = digits_of(map, space);
    const sl_box b = space->bounds;
    sl_sealed parts;
    SL_TRY(sl_find_sealed(context, map, space, &parts));
    const double inside = sl_space_ground(space).inside * (b.max.x - b.min.x) * (b.max.y - b.min.y);
    const double apart = inside > 0 ? 1 - parts.open.area / inside : 0;
    if (apart < APART) return SL_OK;
    const sl_point open = parts.open.at, within = parts.within.at;
    const bool around = parts.open.at_edge && parts.within.area >= APART * inside;
    const bool rooms = around && parts.within.area >= ROOMS * inside;
    if (rooms)
        snprintf(next, sizeof next, "that does not, or with %.*g,%.*g the other one", digits,
                 open.x, digits, open.y);
    else if (around)
        snprintf(next, sizeof next,
                 ", which reaches the map's edge as rock and sea do, or with %.*g,%.*g the largest "
                 "that does not",
                 digits, within.x, digits, within.y);
    else if (parts.largest.area > 0)
        snprintf(next, sizeof next, ", or with %.*g,%.*g the next one", digits, parts.largest.at.x,
                 digits, parts.largest.at.y);
    sl_note(context,
            "the map has no start, so parts that nothing joins all count as inside, as rock, sea "
            "and the insides of obstacles may be; %.2g %% of the area inside is not joined to the "
            "largest part%s: sightline check %s --start %.*g,%.*g keeps the largest%s%s",
            100 * apart, rooms ? ", which reaches the map's edge as rock and sea do" : "",
            say_map(pipeline, &reading, path), digits, rooms ? within.x : open.x, digits,
            rooms ? within.y : open.y, rooms ? " " : "", next);
    return SL_OK;
}

/// Notes the rooms of a drawing that have no opening, if these are many, or `all`.
/// *told: whether there is a note; *open: a place in the rooms that openings join.
static sl_status note_sealed(sl_context *context, const map_pipeline *pipeline, const sl_map *map,
                             const sl_space *space, bool all, bool *told, sl_point *open) {
    const bool given = map->entrance > 0 && !map->entrance_by_doors;
    const double share = all ? 0 : given ? SEALED_BY_WIDTH : SEALED;
    char path[SAID], file[SAID] = "";
    map_pipeline any = pipeline_default();
    const option_table reading = pipeline_option_table(&any);
    const int digits = digits_of(map, space);
    sl_sealed sealed;
    *told = false;
    if (!map->start_count && is_game(context, pipeline, map))
        return note_apart(context, pipeline, map, space);
    // Behind a doubtful opening, other rooms may be those that count.
    if (says_rooms(map) || map->interior.doubtful_width > 0 ||
        !(input_is_drawing(context, pipeline->path) || map->earth.known))
        return SL_OK;
    SL_TRY(sl_find_sealed(context, map, space, &sealed));
    if (sealed.rooms < 2 || sealed.share < share) return SL_OK;
    *told = true;
    *open = sealed.open.at;
    const uint32_t count = sealed.rooms - 1;
    say_map(pipeline, &reading, path);
    say(file, "", pipeline->path);
    sl_note(context,
            "no opening leads to %u room%s, %.2g %% of the area inside (one about %.*g,%.*g): are "
            "doors drawn over the walls, or is furniture among them? sightline check %s "
            "--start %.*g,%.*g -o check.png shows where; sightline info %s lists layers and looks, "
            "--layers A,B takes those of walls",
            (unsigned)count, count == 1 ? "" : "s", 100 * sealed.share, digits, sealed.largest.at.x,
            digits, sealed.largest.at.y, path, digits, sealed.open.at.x, digits, sealed.open.at.y,
            file);
    return SL_OK;
}

sl_status pipeline_note_sealed(sl_context *context, const map_pipeline *pipeline, sl_map *map,
                               const sl_space *space) {
    bool told;
    return note_sealed(context, pipeline, map, space, false, &told, &map->interior.roomiest);
}

/// Notes what say_inside() says, and what to run next.
static sl_status note_said(sl_context *context, const map_pipeline *pipeline, const sl_map *map,
                           const sl_space *space) {
    char said[SL_INSIDE_TEXT], then[2 * SAID];
    sl_inside doubt;
    SL_TRY(sl_say_inside(context, map, space, said));
    if (!said[0]) return SL_OK;
    SL_TRY(sl_doubt_inside(context, map, space, &doubt));
    SL_TRY(say_next(context, pipeline, doubt, map, space, then));
    sl_note(context, "%s%s", said, then);
    return SL_OK;
}

sl_status pipeline_note_inside(sl_context *context, const map_pipeline *pipeline, const sl_map *map,
                               const sl_space *space) {
    bool told;
    sl_point open;
    SL_TRY(note_sealed(context, pipeline, map, space, false, &told, &open));
    return note_said(context, pipeline, map, space);
}

sl_status pipeline_need_inside(sl_context *context, const map_pipeline *pipeline, const sl_map *map,
                               const sl_space *space, const char *or_else) {
    SL_TRY(refuse_inside(context, pipeline, map, space, or_else));
    return pipeline_note_inside(context, pipeline, map, space);
}

sl_status pipeline_prove_inside(sl_context *context, const map_pipeline *pipeline,
                                const sl_map *map, const sl_space *space, bool *doubtful) {
    sl_inside doubt;
    sl_point open;
    SL_TRY(refuse_inside(context, pipeline, map, space, ""));
    SL_TRY(sl_doubt_inside(context, map, space, &doubt));
    SL_TRY(note_sealed(context, pipeline, map, space, true, doubtful, &open));
    SL_TRY(note_said(context, pipeline, map, space));
    *doubtful |= doubt != SL_INSIDE_SURE;
    return SL_OK;
}

static sl_status fail_stray(sl_context *context, const char *path, const sl_map *map,
                            const sl_strays *strays) {
    const sl_stray *stray = &strays->items[0];
    const sl_box rest = strays->rest;
    char message[512], line[SL_LINE_TEXT], more[48] = "";
    snprintf(message, sizeof message, "%s", sl_context_message(context));
    sl_map_say_line(map, stray->line, line);
    if (strays->count > 1) snprintf(more, sizeof more, " and %u more", (unsigned)strays->count - 1);
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "%s; the rest of the map is %.4g by %.4g, and this lies far away: %s, %s%sat "
                   "%.12g,%.12g%s; correct or remove it",
                   message, rest.max.x - rest.min.x, rest.max.y - rest.min.y, sl_path_name(path),
                   line, *line ? ", " : "", stray->at.x, stray->at.y, more);
}

sl_status pipeline_name_stray(sl_context *context, const char *path, const sl_map *map,
                              const sl_space *space, sl_status status) {
    if (status != SL_BAD_ARGUMENT) return status;
    sl_map whole = *map; // baking moves the walls to the space
    sl_strays strays;
    whole.walls = space->walls;
    whole.wall_count = space->wall_count;
    SL_TRY(sl_find_strays(context, &whole, &strays));
    if (strays.count) status = fail_stray(context, path, &whole, &strays);
    sl_strays_destroy(context, &strays);
    return status;
}

// --- help

void pipeline_print_subdivisions(void) {
    puts("\nsubdivisions:");
    size_t count;
    const sl_subdivision *subdivisions = sl_subdivisions(&count);
    for (size_t i = 0; i < count; i++)
        help_name(subdivisions[i].name, 12, subdivisions[i].what, NULL);
    printf("  (default share of the kd-tree's rule 'obscured': %g)\n",
           sl_subdivide_options_default().obscured);
}

void pipeline_print_effects(void) {
    const name_table effects = effect_table();
    printf("\neffects, for --without: ");
    for (size_t i = 0; i < effects.count; i++)
        printf("%s%s", i ? ", " : "", name_table_at(&effects, i));
    putchar('\n');
}

void pipeline_print_methods(void) {
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    puts("\nmethods:");
    for (size_t i = 0; i < count; i++)
        help_name(methods[i].name, 12, methods[i].what,
                  methods[i].stabs ? "as exact as the solver"
                                   : sl_guarantee_name(methods[i].guarantee));
    puts("\nsolvers:");
    for (size_t i = 0; built_solver(i); i++)
        help_name(built_solver(i)->name, 12, built_solver(i)->what,
                  sl_guarantee_name(built_solver(i)->guarantee));
}
