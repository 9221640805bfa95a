/// Files of proofs (place_proof.h): JSON whose members come in one order. The reader takes no other
/// order, so that it needs no tree.
#include "sightline/place_proof.h"
#include "sightline/support.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

// --- of which map

static uint64_t mix(uint64_t sum, uint64_t more) {
    sl_random random = {sum ^ more};
    return sl_random_next(&random);
}

static uint64_t mix_point(uint64_t sum, sl_point p) {
    uint64_t x, y;
    p.x += 0.0; // no -0
    p.y += 0.0;
    memcpy(&x, &p.x, sizeof x);
    memcpy(&y, &p.y, sizeof y);
    return mix(mix(sum, x), y);
}

/// A number for the walls of a space. It keeps mistakes away, not forgers: the check itself relies
/// on nothing but the map.
static uint64_t sum_of(const sl_space *space) {
    uint64_t sum = mix_point(mix_point(space->wall_count, space->bounds.min), space->bounds.max);
    for (uint32_t i = 0; i < space->wall_count; i++)
        sum = mix_point(mix_point(sum, space->walls[i].a), space->walls[i].b);
    return sum;
}

// --- writing

static void put_points(FILE *f, const char *name, size_t count, const sl_viewpoint *viewpoints,
                       const sl_witness *witnesses) {
    char x[SL_NUMBER_TEXT], y[SL_NUMBER_TEXT];
    fprintf(f, ",\n\"%s\": [", name);
    for (size_t i = 0; i < count; i++) {
        const sl_point at = viewpoints ? viewpoints[i].at : witnesses[i].at;
        sl_number_write(at.x, x);
        sl_number_write(at.y, y);
        fprintf(f, "%s\n[%s, %s]", i ? "," : "", x, y);
    }
    fprintf(f, "]");
}

static void put_columns(FILE *f, const sl_cover_problem *all) {
    size_t at = 0;
    fprintf(f, ",\n\"columns\": [");
    for (uint32_t k = 0; k < all->column_count; k++) {
        fprintf(f, "%s\n[", k ? "," : "");
        for (size_t first = at; at < all->ends[k]; at++)
            fprintf(f, "%s%" PRIu32, at > first ? ", " : "", all->entries[at]);
        fprintf(f, "]");
    }
    fprintf(f, "]");
}

static void put_number(FILE *f, uint64_t number, uint64_t none) {
    if (number == none)
        fprintf(f, "null");
    else
        fprintf(f, "%" PRIu64, number);
}

static void put_proof(FILE *f, const sl_cover_proof *p) {
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

/// The integer program in CPLEX' LP format, for other solvers.
static sl_status put_program(sl_context *context, FILE *f, const sl_cover_problem *all) {
    const size_t entries = all->column_count ? all->ends[all->column_count - 1] : 0;
    size_t *first = sl_alloc_array(context, (size_t)all->row_count + 2, sizeof *first);
    uint32_t *columns = sl_alloc_array(context, entries, sizeof *columns);
    const bool made = first && columns;
    size_t at = 0;
    for (size_t i = 0; made && i < entries; i++) first[all->entries[i] + 2]++;
    for (uint32_t i = 1; made && i <= all->row_count; i++) first[i + 1] += first[i];
    for (uint32_t k = 0; made && k < all->column_count; k++)
        for (; at < all->ends[k]; at++) columns[first[all->entries[at] + 1]++] = k;
    fprintf(f, ",\n\"program\": \"Minimize\\n places:");
    for (uint32_t k = 0; k < all->column_count; k++)
        fprintf(f, "%s c%" PRIu32, !k ? "" : k % 10 ? " +" : "\\n +", k);
    fprintf(f, "\\nSubject To\\n");
    for (uint32_t row = 0; made && row < all->row_count; row++) {
        fprintf(f, " w%" PRIu32 ":", row);
        for (size_t i = first[row]; i < first[row + 1]; i++) {
            const size_t n = i - first[row];
            fprintf(f, "%s c%" PRIu32, !n ? "" : n % 10 ? " +" : "\\n +", columns[i]);
        }
        fprintf(f, " >= 1\\n");
    }
    fprintf(f, "Binary\\n");
    for (uint32_t k = 0; k < all->column_count; k++) fprintf(f, " c%" PRIu32 "\\n", k);
    fprintf(f, "End\\n\"");
    sl_free(context, first);
    sl_free(context, columns);
    return made ? SL_OK : SL_NO_MEMORY;
}

sl_status sl_place_proof_print(sl_context *context, sl_query *query, const sl_placement *p,
                               FILE *f) {
    const sl_space *space;
    SL_TRY(sl_query_space(context, query, &space, NULL));
    fprintf(f, "{\"sightline_proof\": 1,\n\"walls\": %" PRIu32 ",\n\"walls_sum\": %" PRIu64,
            space->wall_count, sum_of(space));
    fprintf(f, ",\n\"lower\": %" PRIu64 ",\n\"upper\": %" PRIu64, p->lower, p->upper);
    put_points(f, "viewpoints", p->count, p->viewpoints, NULL);
    put_points(f, "witnesses", p->witness_count, NULL, p->witnesses);
    put_columns(f, &p->columns);
    put_proof(f, &p->proof);
    SL_TRY(put_program(context, f, &p->columns));
    fprintf(f, "}\n");
    return SL_OK;
}

sl_status sl_place_proof_write(sl_context *context, sl_query *query, const sl_placement *placement,
                               const char *path) {
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    return sl_output_close(context, &output,
                           sl_place_proof_print(context, query, placement, output.stream));
}

// --- reading

typedef struct reader {
    sl_context *context;
    const char *path, *at, *end, *member;
    unsigned line;
} reader;

typedef SL_ARRAY(uint64_t) numbers;

static sl_status fail(const reader *r, const char *what) {
    return sl_fail_at(r->context, r->path, r->line, "\"%s\" is no part of a proof: %s", r->member,
                      what);
}

static void skip(reader *r) {
    for (; r->at < r->end && strchr(" \t\r\n", *r->at) && *r->at; r->at++)
        r->line += *r->at == '\n';
}

static bool take(reader *r, char sign) {
    skip(r);
    if (r->at == r->end || *r->at != sign) return false;
    r->at++;
    return true;
}

static sl_status need(reader *r, char sign) {
    char what[] = "' ' is missing";
    what[1] = sign;
    return take(r, sign) ? SL_OK : fail(r, what);
}

/// The key of the next member.
static sl_status key(reader *r, const char *name) {
    const size_t length = strlen(name);
    const bool first = strcmp(name, "sightline_proof") == 0;
    r->member = name;
    if (!take(r, first ? '{' : ',') || !take(r, '"') || (size_t)(r->end - r->at) <= length ||
        memcmp(r->at, name, length) != 0 || r->at[length] != '"')
        return first ? sl_fail_at(r->context, r->path, r->line, "this is no proof of a placement")
                     : fail(r, "it is missing here");
    r->at += length + 1;
    return need(r, ':');
}

/// The number that starts here, of digits and the like.
static const char *word(reader *r, size_t *length) {
    skip(r);
    const char *from = r->at;
    while (r->at < r->end && *r->at && strchr("+-.0123456789Eeaflnrstu", *r->at)) r->at++;
    *length = (size_t)(r->at - from);
    return from;
}

static sl_status real(reader *r, double *out) {
    size_t length;
    const char *text = word(r, &length);
    if (!sl_number_read(text, length, out) || !sl_coordinate_usable(*out))
        return fail(r, "a coordinate is wrong");
    return SL_OK;
}

/// A whole number up to `most`; or null, which is `none`, where that is more.
static sl_status whole(reader *r, uint64_t most, uint64_t none, uint64_t *out) {
    size_t length;
    const char *text = word(r, &length);
    *out = none;
    if (none > most && length == 4 && memcmp(text, "null", 4) == 0) return SL_OK;
    *out = 0;
    for (size_t i = 0; i < length; i++) {
        if (text[i] < '0' || text[i] > '9') return fail(r, "a whole number is wrong");
        const uint64_t digit = (uint64_t)(text[i] - '0');
        if (*out > (UINT64_MAX - digit) / 10) return fail(r, "a whole number is too large");
        *out = 10 * *out + digit;
    }
    if (!length) return fail(r, "a whole number is missing");
    return *out <= most ? SL_OK : fail(r, "a whole number is too large");
}

static sl_status member(reader *r, const char *name, uint64_t most, uint64_t *out) {
    SL_TRY(key(r, name));
    return whole(r, most, 0, out);
}

/// Steps to the next item of a list; *more is false behind the last one.
static sl_status next_item(reader *r, size_t done, bool *more) {
    *more = false;
    if (take(r, ']')) return SL_OK;
    *more = true;
    return done ? need(r, ',') : SL_OK;
}

/// A list of whole numbers, added to those that are there.
static sl_status list(reader *r, uint64_t most, uint64_t none, numbers *out) {
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

typedef SL_ARRAY(sl_point) point_list;

static sl_status points(reader *r, const char *name, point_list *out) {
    bool more = true;
    SL_TRY(key(r, name));
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
    return out->count < UINT32_MAX / 4 ? SL_OK : fail(r, "there are too many");
}

/// A list of lists of whole numbers; of `width` each, unless that is 0. Their ends go to `ends`.
static sl_status table(reader *r, const char *name, size_t width, uint64_t most, uint64_t none,
                       numbers *out, numbers *ends) {
    bool more = true;
    SL_TRY(key(r, name));
    SL_TRY(need(r, '['));
    for (size_t done = 0;; done++) {
        const size_t before = out->count;
        SL_TRY(next_item(r, done, &more));
        if (!more) break;
        SL_TRY(list(r, most, none, out));
        if (width && out->count - before != width) return fail(r, "a row has another length");
        SL_TRY(SL_ARRAY_ROOM(r->context, ends, 1));
        ends->items[ends->count++] = out->count;
    }
    return ends->count < UINT32_MAX / 4 ? SL_OK : fail(r, "there are too many");
}

static sl_status read_viewpoints(reader *r, sl_placement *out) {
    point_list all = {0};
    sl_status status = points(r, "viewpoints", &all);
    if (status == SL_OK && all.count != out->upper)
        status = fail(r, "there are not as many as \"upper\" says");
    if (status == SL_OK) {
        out->viewpoints = sl_alloc_array(r->context, all.count, sizeof *out->viewpoints);
        if (!out->viewpoints) status = SL_NO_MEMORY;
    }
    for (size_t i = 0; status == SL_OK && i < all.count; i++)
        out->viewpoints[i] = (sl_viewpoint){.at = all.items[i], .fov = 360};
    if (status == SL_OK) out->count = (uint32_t)all.count;
    sl_free(r->context, all.items);
    return status;
}

static sl_status read_witnesses(reader *r, sl_placement *out) {
    point_list all = {0};
    sl_status status = points(r, "witnesses", &all);
    if (status == SL_OK) {
        out->witnesses = sl_alloc_array(r->context, all.count, sizeof *out->witnesses);
        if (!out->witnesses) status = SL_NO_MEMORY;
    }
    for (size_t i = 0; status == SL_OK && i < all.count; i++)
        out->witnesses[i] = (sl_witness){all.items[i], true};
    if (status == SL_OK) out->witness_count = (uint32_t)all.count;
    sl_free(r->context, all.items);
    return status;
}

static sl_status keep_columns(reader *r, const numbers *entries, const numbers *ends,
                              sl_placement *out) {
    size_t *all_ends = sl_alloc_array(r->context, ends->count, sizeof *all_ends);
    uint32_t *all = sl_alloc_array(r->context, entries->count, sizeof *all);
    out->columns =
        (sl_cover_problem){out->witness_count, (uint32_t)ends->count, all_ends, all, NULL, NULL};
    if (!all_ends || !all) return SL_NO_MEMORY;
    size_t at = 0;
    for (size_t k = 0; k < ends->count; k++)
        for (all_ends[k] = (size_t)ends->items[k]; at < all_ends[k]; at++) {
            const bool first = at == (k ? all_ends[k - 1] : 0);
            if (!first && entries->items[at] <= entries->items[at - 1])
                return fail(r, "witnesses of a column must ascend");
            all[at] = (uint32_t)entries->items[at];
        }
    return SL_OK;
}

static sl_status read_columns(reader *r, sl_placement *out) {
    numbers entries = {0}, ends = {0};
    const uint64_t most = out->witness_count ? out->witness_count - 1 : 0;
    sl_status status = table(r, "columns", 0, most, 0, &entries, &ends);
    if (status == SL_OK && entries.count && !out->witness_count)
        status = fail(r, "there are no witnesses");
    if (status == SL_OK) status = keep_columns(r, &entries, &ends, out);
    sl_free(r->context, entries.items);
    sl_free(r->context, ends.items);
    return status;
}

static sl_status read_steps(reader *r, sl_cover_proof *p) {
    numbers all = {0}, ends = {0};
    sl_status status = table(r, "steps", 3, UINT32_MAX, 0, &all, &ends);
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

static sl_status read_nodes(reader *r, sl_cover_proof *p) {
    numbers all = {0}, ends = {0};
    sl_status status = table(r, "nodes", 4, (uint64_t)UINT32_MAX << 20, UINT64_MAX, &all, &ends);
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
                status = fail(r, "a whole number is too large");
        }
        p->nodes[p->node_count++] = (sl_cover_node){
            small[0], {small[1], small[2]}, n[3] >= SIZE_MAX ? SIZE_MAX : (size_t)n[3]};
    }
    sl_free(r->context, all.items);
    sl_free(r->context, ends.items);
    return status;
}

static sl_status read_proof(reader *r, sl_placement *out) {
    sl_cover_proof *p = &out->proof;
    numbers parts = {0}, duals = {0};
    uint64_t part_count = 0;
    SL_TRY(member(r, "denominator", UINT64_MAX, &p->denominator));
    SL_TRY(read_steps(r, p));
    SL_TRY(member(r, "part_count", out->witness_count, &part_count));
    p->part_count = (uint32_t)part_count;
    sl_status status = key(r, "parts");
    if (status == SL_OK) status = list(r, UINT32_MAX, 0, &parts);
    if (status == SL_OK && parts.count != out->witness_count)
        status = fail(r, "there must be one for each witness");
    if (status == SL_OK) status = read_nodes(r, p);
    if (status == SL_OK) status = key(r, "duals");
    if (status == SL_OK) status = list(r, UINT64_MAX, 0, &duals);
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

/// The program is for others: it is passed over.
static sl_status read_end(reader *r) {
    SL_TRY(key(r, "program"));
    SL_TRY(need(r, '"'));
    while (r->at < r->end && *r->at != '"') r->at++;
    SL_TRY(need(r, '"'));
    SL_TRY(need(r, '}'));
    skip(r);
    return r->at == r->end ? SL_OK : fail(r, "something follows it");
}

static sl_status read_all(reader *r, const sl_space *space, sl_placement *out) {
    uint64_t version, walls, sum;
    SL_TRY(member(r, "sightline_proof", UINT64_MAX, &version));
    if (version != 1) return fail(r, "this version is not known");
    SL_TRY(member(r, "walls", UINT64_MAX, &walls));
    SL_TRY(member(r, "walls_sum", UINT64_MAX, &sum));
    if (walls != space->wall_count || sum != sum_of(space))
        return sl_fail_at(
            r->context, r->path, r->line,
            "this proof is for another map: it has %" PRIu64 " walls, and this one %" PRIu32 "%s",
            walls, space->wall_count, walls == space->wall_count ? ", some of them elsewhere" : "");
    SL_TRY(member(r, "lower", UINT64_MAX, &out->lower));
    SL_TRY(member(r, "upper", UINT32_MAX, &out->upper));
    SL_TRY(read_viewpoints(r, out));
    SL_TRY(read_witnesses(r, out));
    SL_TRY(read_columns(r, out));
    SL_TRY(read_proof(r, out));
    return read_end(r);
}

sl_status sl_place_proof_parse(sl_context *context, sl_query *query, const char *path,
                               const char *text, size_t size, sl_placement *out) {
    const sl_space *space;
    reader r = {context, path, text, text + size, "", 1};
    *out = (sl_placement){0};
    SL_TRY(sl_query_space(context, query, &space, NULL));
    const sl_status status = read_all(&r, space, out);
    if (status != SL_OK) sl_placement_destroy(context, out);
    return status;
}

sl_status sl_place_proof_read(sl_context *context, sl_query *query, const char *path,
                              sl_placement *out) {
    sl_bytes text;
    *out = (sl_placement){0};
    SL_TRY(sl_file_read(context, path, &text));
    const sl_status status = sl_place_proof_parse(context, query, path, text.data, text.size, out);
    sl_free(context, text.data);
    return status;
}
