/// What files of proofs share (proof_json.h).
#include "analysis/placement/proof_json.h"

#include "map/scan.h"

#include <inttypes.h>
#include <string.h>

// --- of which map

uint64_t sli_proof_mix(uint64_t sum, uint64_t more) {
    sl_random random = {sum ^ more};
    return sl_random_next(&random);
}

uint64_t sli_proof_mix_real(uint64_t sum, double more) {
    uint64_t bits;
    more += 0.0; // no -0
    memcpy(&bits, &more, sizeof bits);
    return sli_proof_mix(sum, bits);
}

uint64_t sli_proof_mix_point(uint64_t sum, sl_point more) {
    return sli_proof_mix_real(sli_proof_mix_real(sum, more.x), more.y);
}

/// A number for the walls of a space. It keeps mistakes away, not forgers: the check itself relies
/// on nothing but the map.
static uint64_t sum_of(const sl_space *space) {
    uint64_t sum = sli_proof_mix_point(sli_proof_mix_point(space->wall_count, space->bounds.min),
                                       space->bounds.max);
    for (uint32_t i = 0; i < space->wall_count; i++)
        sum = sli_proof_mix_point(sli_proof_mix_point(sum, space->walls[i].a), space->walls[i].b);
    return sum;
}

// --- writing

void sli_proof_put_head(FILE *f, uint64_t version, const sl_space *space) {
    fprintf(f,
            "{\"sightline_proof\": %" PRIu64 ",\n\"walls\": %" PRIu32 ",\n\"walls_sum\": %" PRIu64,
            version, space->wall_count, sum_of(space));
}

void sli_proof_put_points(FILE *f, const char *name, const void *items, size_t size, size_t count) {
    char x[SL_NUMBER_TEXT], y[SL_NUMBER_TEXT];
    fprintf(f, ",\n\"%s\": [", name);
    for (size_t i = 0; i < count; i++) {
        sl_point at;
        memcpy(&at, (const char *)items + i * size, sizeof at);
        sl_number_write(at.x, x);
        sl_number_write(at.y, y);
        fprintf(f, "%s\n[%s, %s]", i ? "," : "", x, y);
    }
    fprintf(f, "]");
}

void sli_proof_put_numbers(FILE *f, const char *name, const uint32_t *all, size_t count) {
    fprintf(f, ",\n\"%s\": [", name);
    for (size_t i = 0; i < count; i++) fprintf(f, "%s%" PRIu32, i ? ", " : "", all[i]);
    fprintf(f, "]");
}

static void put_number(FILE *f, uint64_t number, uint64_t none) {
    if (number == none)
        fprintf(f, "null");
    else
        fprintf(f, "%" PRIu64, number);
}

static void put_trees(FILE *f, const sl_cover_proof *p) {
    fprintf(f, ",\n\"denominator\": %" PRIu64 ",\n\"steps\": [", p->denominator);
    for (uint32_t i = 0; i < p->step_count; i++)
        fprintf(f, "%s\n[%" PRIu32 ", %" PRIu32 ", %" PRIu32 "]", i ? "," : "", p->steps[i].kind,
                p->steps[i].what, p->steps[i].by);
    fprintf(f, "],\n\"part_count\": %" PRIu32 ",\n\"parts\": [", p->part_count);
    for (uint32_t i = 0; i < p->row_count; i++)
        fprintf(f, "%s%" PRIu32, i ? ", " : "", p->parts[i]);
    fprintf(f, "],\n\"nodes\": [");
    for (uint32_t i = 0; i < p->node_count; i++) {
        const sl_cover_node *n = &p->nodes[i];
        fprintf(f, "%s\n[", i ? "," : "");
        put_number(f, n->column, UINT32_MAX);
        fprintf(f, ", ");
        put_number(f, n->children[0], UINT32_MAX);
        fprintf(f, ", ");
        put_number(f, n->children[1], UINT32_MAX);
        fprintf(f, ", ");
        put_number(f, n->duals == SIZE_MAX ? UINT64_MAX : n->duals, UINT64_MAX);
        fprintf(f, "]");
    }
    fprintf(f, "],\n\"duals\": [");
    for (size_t i = 0; i < p->dual_count; i++) fprintf(f, "%s%" PRIu64, i ? ", " : "", p->duals[i]);
    fprintf(f, "]");
}

static void put_splits(FILE *f, const sl_cover_proof *p) {
    fprintf(f, ",\n\"splits\": [");
    for (uint32_t i = 0; i < p->split_count; i++) {
        const sl_cover_split *s = &p->splits[i];
        fprintf(f, "%s\n{\"unit\": %" PRIu32, i ? "," : "", s->unit);
        sli_proof_put_numbers(f, "blocks", s->blocks, s->row_count);
        sli_proof_put_numbers(f, "costs", s->costs, s->cost_count);
        put_trees(f, s->rest);
        fprintf(f, "}");
    }
    fprintf(f, "]");
}

static void put_raised(FILE *f, const sl_cover_proof *p) {
    fprintf(f, ",\n\"raised\": [");
    for (uint32_t i = 0; i < p->raised_count; i++) {
        const sl_cover_cuts *c = &p->raised[i];
        fprintf(f, "%s\n{\"rows\": %" PRIu32 ",\n\"cuts\": [", i ? "," : "", c->row_count);
        for (uint32_t cut = 0; cut < c->cut_count; cut++) {
            const size_t first = cut ? c->ends[cut - 1] : 0;
            fprintf(f, "%s\n[", cut ? "," : "");
            for (size_t k = first; k < c->ends[cut]; k++)
                fprintf(f, "%s%" PRIu32, k > first ? ", " : "", c->rows[k]);
            fprintf(f, "]");
        }
        fprintf(f, "]");
        put_trees(f, c->rest);
        fprintf(f, "}");
    }
    fprintf(f, "]");
}

void sli_proof_put_cover(FILE *f, const sl_cover_proof *p) {
    put_trees(f, p);
    if (p->split_count) put_splits(f, p);
    if (p->raised_count) put_raised(f, p);
}

/// The columns of each row, one row after the other: the first of row r is at first[r].
static bool turn(const sl_cover_problem *all, size_t *first, uint32_t *columns) {
    const size_t entries = all->column_count ? all->ends[all->column_count - 1] : 0;
    size_t at = 0;
    if (!first || !columns) return false;
    for (size_t i = 0; i < entries; i++) first[all->entries[i] + 2]++;
    for (uint32_t i = 1; i <= all->row_count; i++) first[i + 1] += first[i];
    for (uint32_t k = 0; k < all->column_count; k++)
        for (; at < all->ends[k]; at++) columns[first[all->entries[at] + 1]++] = k;
    return true;
}

sl_status sli_proof_put_program(sl_context *context, FILE *f, const sl_cover_problem *all) {
    const size_t entries = all->column_count ? all->ends[all->column_count - 1] : 0;
    size_t *first = sl_alloc_array(context, (size_t)all->row_count + 2, sizeof *first);
    uint32_t *columns = sl_alloc_array(context, entries, sizeof *columns);
    const bool made = turn(all, first, columns);
    fprintf(f, ",\n\"program\": \"Minimize\\n places:");
    for (uint32_t k = 0; k < all->column_count; k++) {
        fprintf(f, "%s", !k ? "" : k % 10 ? " +" : "\\n +");
        if (all->costs && all->costs[k] != 1) fprintf(f, " %" PRIu32, all->costs[k]);
        fprintf(f, " c%" PRIu32, k);
    }
    fprintf(f, "\\nSubject To\\n");
    for (uint32_t row = 0; made && row < all->row_count; row++) {
        const uint32_t demand = all->demands ? all->demands[row] : 1;
        if (!demand) continue;
        fprintf(f, " w%" PRIu32 ":", row);
        for (size_t i = first[row]; i < first[row + 1]; i++) {
            const size_t n = i - first[row];
            fprintf(f, "%s c%" PRIu32, !n ? "" : n % 10 ? " +" : "\\n +", columns[i]);
        }
        fprintf(f, " >= %" PRIu32 "\\n", demand);
    }
    fprintf(f, "Binary\\n");
    for (uint32_t k = 0; k < all->column_count; k++) fprintf(f, " c%" PRIu32 "\\n", k);
    fprintf(f, "End\\n\"");
    sl_free(context, first);
    sl_free(context, columns);
    return made ? SL_OK : SL_NO_MEMORY;
}

// --- reading

sli_proof_reader sli_proof_reader_of(sl_context *context, const char *path, const char *text,
                                     size_t size) {
    return (sli_proof_reader){context, path, sli_skip_mark(text, size), text + size, "", 1};
}

sl_status sli_proof_fail(const sli_proof_reader *r, const char *what) {
    return sl_fail_at(r->context, r->path, r->line, "\"%s\" is no part of a proof: %s", r->member,
                      what);
}

static void skip(sli_proof_reader *r) {
    for (; r->at < r->end && strchr(" \t\r\n", *r->at) && *r->at; r->at++)
        r->line += *r->at == '\n';
}

static bool take(sli_proof_reader *r, char sign) {
    skip(r);
    if (r->at == r->end || *r->at != sign) return false;
    r->at++;
    return true;
}

static sl_status need(sli_proof_reader *r, char sign) {
    char what[] = "' ' is missing";
    what[1] = sign;
    return take(r, sign) ? SL_OK : sli_proof_fail(r, what);
}

/// Takes a sign and a name in quotes.
static bool take_name(sli_proof_reader *r, char sign, const char *name) {
    const size_t length = strlen(name);
    if (!take(r, sign) || !take(r, '"') || (size_t)(r->end - r->at) <= length ||
        memcmp(r->at, name, length) != 0 || r->at[length] != '"')
        return false;
    r->at += length + 1;
    return true;
}

sl_status sli_proof_key(sli_proof_reader *r, const char *name) {
    const bool first = strcmp(name, "sightline_proof") == 0;
    r->member = name;
    const bool opens = first || strcmp(name, "unit") == 0 || strcmp(name, "rows") == 0;
    if (!take_name(r, opens ? '{' : ',', name))
        return first ? sl_fail_at(r->context, r->path, r->line, "this is no proof of a placement")
                     : sli_proof_fail(r, "it is missing here");
    return need(r, ':');
}

/// The number that starts here, of digits and the like.
static const char *word(sli_proof_reader *r, size_t *length) {
    skip(r);
    const char *from = r->at;
    while (r->at < r->end && *r->at && strchr("+-.0123456789Eeaflnrstu", *r->at)) r->at++;
    *length = (size_t)(r->at - from);
    return from;
}

static sl_status real(sli_proof_reader *r, double *out) {
    size_t length;
    const char *text = word(r, &length);
    if (!sl_number_read(text, length, out) || !sl_coordinate_usable(*out))
        return sli_proof_fail(r, "a coordinate is wrong");
    return SL_OK;
}

/// A whole number up to `most`; or null, which is `none`, where that is more.
static sl_status whole(sli_proof_reader *r, uint64_t most, uint64_t none, uint64_t *out) {
    size_t length;
    const char *text = word(r, &length);
    *out = none;
    if (none > most && length == 4 && memcmp(text, "null", 4) == 0) return SL_OK;
    *out = 0;
    for (size_t i = 0; i < length; i++) {
        if (text[i] < '0' || text[i] > '9') return sli_proof_fail(r, "a whole number is wrong");
        const uint64_t digit = (uint64_t)(text[i] - '0');
        if (*out > (UINT64_MAX - digit) / 10)
            return sli_proof_fail(r, "a whole number is too large");
        *out = 10 * *out + digit;
    }
    if (!length) return sli_proof_fail(r, "a whole number is missing");
    return *out <= most ? SL_OK : sli_proof_fail(r, "a whole number is too large");
}

sl_status sli_proof_member(sli_proof_reader *r, const char *name, uint64_t most, uint64_t *out) {
    SL_TRY(sli_proof_key(r, name));
    return whole(r, most, 0, out);
}

/// Steps to the next item of a list; *more is false behind the last one.
static sl_status next_item(sli_proof_reader *r, size_t done, bool *more) {
    *more = false;
    if (take(r, ']')) return SL_OK;
    *more = true;
    return done ? need(r, ',') : SL_OK;
}

sl_status sli_proof_list(sli_proof_reader *r, uint64_t most, uint64_t none,
                         sli_proof_numbers *out) {
    bool more = true;
    SL_TRY(need(r, '['));
    for (size_t done = 0;; done++) {
        SL_TRY(next_item(r, done, &more));
        if (!more) return SL_OK;
        SL_TRY(SL_ARRAY_ROOM(r->context, out, 1));
        SL_TRY(whole(r, most, none, &out->items[out->count]));
        out->count++;
    }
}

sl_status sli_proof_read_points(sli_proof_reader *r, const char *name, sli_proof_points *out) {
    bool more = true;
    SL_TRY(sli_proof_key(r, name));
    SL_TRY(need(r, '['));
    for (size_t done = 0;; done++) {
        SL_TRY(next_item(r, done, &more));
        if (!more) break;
        SL_TRY(SL_ARRAY_ROOM(r->context, out, 1));
        sl_point *p = &out->items[out->count];
        SL_TRY(need(r, '['));
        SL_TRY(real(r, &p->x));
        SL_TRY(need(r, ','));
        SL_TRY(real(r, &p->y));
        SL_TRY(need(r, ']'));
        out->count++;
    }
    return out->count < UINT32_MAX / 4 ? SL_OK : sli_proof_fail(r, "there are too many");
}

sl_status sli_proof_table(sli_proof_reader *r, const char *name, size_t width, uint64_t most,
                          uint64_t none, sli_proof_numbers *out, sli_proof_numbers *ends) {
    bool more = true;
    SL_TRY(sli_proof_key(r, name));
    SL_TRY(need(r, '['));
    for (size_t done = 0;; done++) {
        const size_t before = out->count;
        SL_TRY(next_item(r, done, &more));
        if (!more) break;
        SL_TRY(sli_proof_list(r, most, none, out));
        if (width && out->count - before != width)
            return sli_proof_fail(r, "a row has another length");
        SL_TRY(SL_ARRAY_ROOM(r->context, ends, 1));
        ends->items[ends->count++] = out->count;
    }
    return ends->count < UINT32_MAX / 4 ? SL_OK : sli_proof_fail(r, "there are too many");
}

sl_status sli_proof_read_head(sli_proof_reader *r, uint64_t known, const sl_space *space) {
    uint64_t version, walls, sum;
    SL_TRY(sli_proof_member(r, "sightline_proof", UINT64_MAX, &version));
    if (version == SLI_PROOF_ANYWHERE && known == SLI_PROOF_AREA)
        return sl_fail_at(r->context, r->path, r->line,
                          "this proof is of viewpoints anywhere, not among given places");
    if (version == SLI_PROOF_AREA && known == SLI_PROOF_ANYWHERE)
        return sl_fail_at(
            r->context, r->path, r->line,
            "this proof is of viewpoints among given places, not anywhere: give these "
            "places, as in the run that wrote it");
    if (version != known) return sli_proof_fail(r, "this version is not known");
    SL_TRY(sli_proof_member(r, "walls", UINT64_MAX, &walls));
    SL_TRY(sli_proof_member(r, "walls_sum", UINT64_MAX, &sum));
    if (walls != space->wall_count || sum != sum_of(space))
        return sl_fail_at(
            r->context, r->path, r->line,
            "this proof is for another map: it has %" PRIu64 " walls, and this one %" PRIu32 "%s",
            walls, space->wall_count, walls == space->wall_count ? ", some of them elsewhere" : "");
    return SL_OK;
}

static sl_status read_steps(sli_proof_reader *r, sl_cover_proof *p) {
    sli_proof_numbers all = {0}, ends = {0};
    sl_status status = sli_proof_table(r, "steps", 3, UINT32_MAX, 0, &all, &ends);
    if (status == SL_OK) {
        p->steps = sl_alloc_array(r->context, ends.count, sizeof *p->steps);
        if (!p->steps) status = SL_NO_MEMORY;
    }
    for (size_t i = 0; status == SL_OK && i < ends.count; i++) {
        const uint64_t *n = all.items + 3 * i;
        p->steps[p->step_count++] = (sl_cover_step){(uint32_t)n[0], (uint32_t)n[1], (uint32_t)n[2]};
    }
    sl_free(r->context, all.items);
    sl_free(r->context, ends.items);
    return status;
}

static sl_status read_nodes(sli_proof_reader *r, sl_cover_proof *p) {
    sli_proof_numbers all = {0}, ends = {0};
    sl_status status =
        sli_proof_table(r, "nodes", 4, (uint64_t)UINT32_MAX << 20, UINT64_MAX, &all, &ends);
    if (status == SL_OK) {
        p->nodes = sl_alloc_array(r->context, ends.count, sizeof *p->nodes);
        if (!p->nodes) status = SL_NO_MEMORY;
    }
    for (size_t i = 0; status == SL_OK && i < ends.count; i++) {
        const uint64_t *n = all.items + 4 * i;
        uint32_t small[3];
        for (int k = 0; k < 3; k++) {
            small[k] = n[k] == UINT64_MAX ? UINT32_MAX : (uint32_t)n[k];
            if (n[k] != UINT64_MAX && n[k] >= UINT32_MAX)
                status = sli_proof_fail(r, "a whole number is too large");
        }
        p->nodes[p->node_count++] = (sl_cover_node){
            small[0], {small[1], small[2]}, n[3] >= SIZE_MAX ? SIZE_MAX : (size_t)n[3]};
    }
    sl_free(r->context, all.items);
    sl_free(r->context, ends.items);
    return status;
}

static sl_status read_trees(sli_proof_reader *r, uint32_t rows, sl_cover_proof *p) {
    sli_proof_numbers parts = {0}, duals = {0};
    uint64_t part_count = 0;
    SL_TRY(sli_proof_member(r, "denominator", UINT64_MAX, &p->denominator));
    SL_TRY(read_steps(r, p));
    SL_TRY(sli_proof_member(r, "part_count", rows, &part_count));
    p->part_count = (uint32_t)part_count;
    sl_status status = sli_proof_key(r, "parts");
    if (status == SL_OK) status = sli_proof_list(r, UINT32_MAX, 0, &parts);
    if (status == SL_OK && parts.count != rows)
        status = sli_proof_fail(r, "there must be one for each witness");
    if (status == SL_OK) status = read_nodes(r, p);
    if (status == SL_OK) status = sli_proof_key(r, "duals");
    if (status == SL_OK) status = sli_proof_list(r, UINT64_MAX, 0, &duals);
    if (status == SL_OK) {
        p->parts = sl_alloc_array(r->context, parts.count, sizeof *p->parts);
        p->duals = duals.items;
        p->dual_count = duals.count;
        duals.items = NULL;
        if (!p->parts) status = SL_NO_MEMORY;
    }
    for (size_t i = 0; status == SL_OK && i < parts.count; i++)
        p->parts[p->row_count++] = (uint32_t)parts.items[i];
    sl_free(r->context, parts.items);
    sl_free(r->context, duals.items);
    return status;
}

/// Whether a member comes next.
static bool is_next(const sli_proof_reader *r, const char *name) {
    sli_proof_reader ahead = *r;
    return take_name(&ahead, ',', name);
}

static sl_status read_small(sli_proof_reader *r, const char *name, uint32_t **out,
                            uint32_t *count) {
    sli_proof_numbers all = {0};
    SL_TRY(sli_proof_key(r, name));
    sl_status status = sli_proof_list(r, UINT32_MAX, 0, &all);
    if (status == SL_OK && all.count > UINT32_MAX / 4)
        status = sli_proof_fail(r, "there are too many");
    if (status == SL_OK) {
        *out = sl_alloc_array(r->context, all.count, sizeof **out);
        if (!*out) status = SL_NO_MEMORY;
    }
    for (size_t i = 0; status == SL_OK && i < all.count; i++)
        (*out)[(*count)++] = (uint32_t)all.items[i];
    sl_free(r->context, all.items);
    return status;
}

static sl_status read_split(sli_proof_reader *r, sl_cover_split *out) {
    uint64_t unit;
    SL_TRY(sli_proof_member(r, "unit", UINT32_MAX, &unit));
    out->unit = (uint32_t)unit;
    SL_TRY(read_small(r, "blocks", &out->blocks, &out->row_count));
    SL_TRY(read_small(r, "costs", &out->costs, &out->cost_count));
    out->rest = sl_alloc_array(r->context, 1, sizeof *out->rest);
    if (!out->rest) return SL_NO_MEMORY;
    SL_TRY(read_trees(r, out->row_count, out->rest));
    return need(r, '}');
}

/// The ends and rows of all cuts, as they are in the file.
static sl_status take_cuts(sli_proof_reader *r, const sli_proof_numbers *all,
                           const sli_proof_numbers *ends, sl_cover_cuts *out) {
    out->ends = sl_alloc_array(r->context, ends->count, sizeof *out->ends);
    out->rows = sl_alloc_array(r->context, all->count, sizeof *out->rows);
    if (!out->ends || !out->rows) return SL_NO_MEMORY;
    for (size_t i = 0; i < ends->count; i++) out->ends[out->cut_count++] = (size_t)ends->items[i];
    for (size_t i = 0; i < all->count; i++) out->rows[i] = (uint32_t)all->items[i];
    return SL_OK;
}

static sl_status read_cuts(sli_proof_reader *r, sl_cover_cuts *out) {
    uint64_t rows;
    sli_proof_numbers all = {0}, ends = {0};
    SL_TRY(sli_proof_member(r, "rows", UINT32_MAX / 4, &rows));
    out->row_count = (uint32_t)rows;
    sl_status status = sli_proof_table(r, "cuts", 0, UINT32_MAX, 0, &all, &ends);
    if (status == SL_OK) status = take_cuts(r, &all, &ends, out);
    sl_free(r->context, all.items);
    sl_free(r->context, ends.items);
    SL_TRY(status);
    out->rest = sl_alloc_array(r->context, 1, sizeof *out->rest);
    if (!out->rest) return SL_NO_MEMORY;
    SL_TRY(read_trees(r, out->row_count + out->cut_count, out->rest));
    return need(r, '}');
}

typedef SL_ARRAY(sl_cover_split) split_list;
typedef SL_ARRAY(sl_cover_cuts) cuts_list;

/// A list of splits, or of cuts.
static sl_status read_others(sli_proof_reader *r, const char *name, split_list *splits,
                             cuts_list *raised) {
    bool more = true;
    size_t done = 0;
    SL_TRY(sli_proof_key(r, name));
    SL_TRY(need(r, '['));
    for (;; done++) {
        SL_TRY(next_item(r, done, &more));
        if (!more) break;
        if (splits) {
            SL_TRY(SL_ARRAY_ROOM(r->context, splits, 1));
            splits->items[splits->count] = (sl_cover_split){0};
            SL_TRY(read_split(r, &splits->items[splits->count++]));
        } else {
            SL_TRY(SL_ARRAY_ROOM(r->context, raised, 1));
            raised->items[raised->count] = (sl_cover_cuts){0};
            SL_TRY(read_cuts(r, &raised->items[raised->count++]));
        }
    }
    return done < UINT32_MAX / 4 ? SL_OK : sli_proof_fail(r, "there are too many");
}

sl_status sli_proof_read_cover(sli_proof_reader *r, uint32_t rows, sl_cover_proof *p) {
    split_list splits = {0};
    cuts_list raised = {0};
    SL_TRY(read_trees(r, rows, p));
    sl_status status = SL_OK;
    if (is_next(r, "splits")) status = read_others(r, "splits", &splits, NULL);
    if (status == SL_OK && is_next(r, "raised")) status = read_others(r, "raised", NULL, &raised);
    p->splits = splits.items;
    p->split_count = (uint32_t)splits.count;
    p->raised = raised.items;
    p->raised_count = (uint32_t)raised.count;
    return status;
}

sl_status sli_proof_read_end(sli_proof_reader *r) {
    SL_TRY(sli_proof_key(r, "program"));
    SL_TRY(need(r, '"'));
    while (r->at < r->end && *r->at != '"') r->at++;
    SL_TRY(need(r, '"'));
    SL_TRY(need(r, '}'));
    skip(r);
    return r->at == r->end ? SL_OK : sli_proof_fail(r, "something follows it");
}
