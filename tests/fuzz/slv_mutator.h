/// Mutations of baked files, for fuzzers whose input they are. A checksum, a size and a table of
/// places guard the file, and would end nearly every mutation there: so files are taken apart into
/// their sections, one of which is changed, and put together again. Seeds are map texts, which are
/// baked on the way. Some files are mutated blindly, and some of those are given their checksum
/// again.
#ifndef SL_SLV_MUTATOR_H
#define SL_SLV_MUTATOR_H

#include "cell_to_cell/pvs_rows.h"
#include "fuzz.h"
#include "space/subdivide.h"

#include "bake/slv.h"
#include "baked_bytes.h"
#include "map/scan.h"
#include "sightline/stab.h"
#include "sightline/support.h"

#include <math.h>
#include <zlib.h>

size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t max_size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed);
size_t LLVMFuzzerCustomCrossOver(const uint8_t *data, size_t size, const uint8_t *other,
                                 size_t other_size, uint8_t *out, size_t max_size, unsigned seed);

static bool is_baked(const uint8_t *data, size_t size) {
    return size >= sizeof(sli_slv_header) && memcmp(data, SLI_SLV_MAGIC, 8) == 0;
}

// --- a file and its parts

enum { MOST_PARTS = 48, MOST_BYTES = 1 << 14 };

typedef struct part {
    char tag[4];
    uint32_t item_bytes;
    size_t size;
    uint64_t bytes[MOST_BYTES / 8]; // whatever they are, aligned for it
} part;

typedef struct parts {
    uint32_t version, count;
    part part[MOST_PARTS];
} parts;

static bool take_apart(const uint8_t *data, size_t size, parts *out) {
    sli_slv_header header;
    if (!is_baked(data, size)) return false;
    memcpy(&header, data, sizeof header);
    out->version = header.version;
    out->count = header.section_count;
    if (out->count > MOST_PARTS || out->count > (size - sizeof header) / sizeof(sli_slv_section))
        return false;
    for (uint32_t i = 0; i < out->count; i++) {
        sli_slv_section s;
        memcpy(&s, data + sizeof header + i * sizeof s, sizeof s);
        if (!s.item_bytes || s.offset > size || s.count > (size - s.offset) / s.item_bytes ||
            s.count * s.item_bytes > MOST_BYTES)
            return false;
        part *p = &out->part[i];
        memcpy(p->tag, s.tag, sizeof p->tag);
        p->item_bytes = s.item_bytes;
        p->size = s.count * s.item_bytes;
        memcpy(p->bytes, data + s.offset, p->size);
    }
    return true;
}

/// Makes the header right for the bytes behind it.
static void seal(uint8_t *data, size_t size, uint32_t version, uint32_t section_count) {
    sli_slv_header header = {.version = version,
                             .byte_order = SLI_SLV_BYTE_ORDER,
                             .file_bytes = size,
                             .section_count = section_count};
    memcpy(header.magic, SLI_SLV_MAGIC, sizeof header.magic);
    memcpy(data, &header, sizeof header);
    header.checksum = (uint32_t)crc32(0, data, (uInt)size);
    memcpy(data, &header, sizeof header);
}

/// The file's size; 0 where it does not fit.
static size_t put_together(const parts *in, uint8_t *data, size_t max_size) {
    size_t at = sizeof(sli_slv_header) + in->count * sizeof(sli_slv_section);
    size_t size = at;
    for (uint32_t i = 0; i < in->count; i++) size += (in->part[i].size + 7) / 8 * 8;
    if (size > max_size) return 0;
    memset(data, 0, size);
    for (uint32_t i = 0; i < in->count; i++) {
        const part *p = &in->part[i];
        sli_slv_section s = {
            .item_bytes = p->item_bytes, .offset = at, .count = p->size / p->item_bytes};
        memcpy(s.tag, p->tag, sizeof s.tag);
        memcpy(data + sizeof(sli_slv_header) + i * sizeof s, &s, sizeof s);
        memcpy(data + at, p->bytes, p->size);
        at += (p->size + 7) / 8 * 8;
    }
    seal(data, size, in->version, in->count);
    return size;
}

static part *find_part(parts *all, const char *tag) {
    for (uint32_t i = 0; i < all->count; i++)
        if (memcmp(all->part[i].tag, tag, 4) == 0) return &all->part[i];
    return NULL;
}

// --- baking a seed

/// Gives up a search that takes long.
static bool is_enough(void *user) {
    int *left = user;
    return --*left < 0;
}

static sl_status bake(sl_context *context, const uint8_t *text, size_t size, sl_baked *out) {
    SL_TRY(sli_map_read_text(context, "input", (const char *)text, size, &out->map));
    SL_TRY(sl_map_clean(context, &out->map, NULL, NULL));
    const sl_subdivide_options rules = sl_subdivide_options_default();
    if (size & 16 || sli_subdivide_kd(context, &out->map, &rules, &out->space) == SL_BAD_INPUT)
        SL_TRY(sli_subdivide_mesh(context, &out->map, &out->space));
    if (!out->space.cell_count) return SL_CANCELLED;
    out->map.wall_count = 0;
    sl_see_options options = sl_see_options_default();
    options.solver = sl_funnel();
    options.sight = size & 1 ? SL_CLOSED : SL_OPEN;
    options.trees = size & 2;
    options.tree_bytes = size & 4 ? 400 : 4000;
    options.inside_only = size & 8;
    options.threads = 1;
    const sl_plan plan = sl_plan_make(&out->map);
    if (size & 32) options.plan = &plan;
    size_t count;
    SL_TRY(sl_see_methods(&count)->see(context, &out->space, &options, &out->visibility));
    snprintf(out->method, sizeof out->method, "%s", sl_see_methods(&count)->name);
    snprintf(out->solver, sizeof out->solver, "%s", options.solver->name);
    return SL_OK;
}

/// What a map text bakes to, for free(); NULL where it does not.
static char *baked_text(const uint8_t *text, size_t text_size, size_t *size) {
    int patience = 2000;
    const sl_hooks hooks = {.user = &patience, .cancelled = is_enough};
    sl_context *context = sl_context_create(&hooks);
    FUZZ_CHECK(context);
    sl_baked baked = {0};
    char *bytes = NULL;
    if (bake(context, text, text_size, &baked) == SL_OK) {
        patience = 2000;
        bytes = baked_bytes(context, &baked, size);
    }
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
    return bytes;
}

// --- mutations

static void mutate_bytes(part *p) {
    uint8_t *bytes = (uint8_t *)p->bytes;
    p->size = LLVMFuzzerMutate(bytes, p->size, p->size + p->item_bytes);
    p->size -= p->size % p->item_bytes;
}

static void set_number(part *p, sl_random *random) {
    const size_t places = p->size / 8;
    if (!places) return;
    uint64_t *at = &p->bytes[sl_random_below(random, places)];
    if (sl_random_below(random, 2)) {
        const double real = odd_real(random);
        memcpy(at, &real, sizeof real);
    } else {
        uint32_t halves[2];
        memcpy(halves, at, sizeof halves);
        uint32_t *half = &halves[sl_random_below(random, 2)];
        const uint32_t count = odd_count(random);
        *half = sl_random_below(random, 2) ? count : *half + count;
        memcpy(at, halves, sizeof halves);
    }
}

/// One item over another.
static void copy_item(part *p, sl_random *random) {
    const size_t count = p->size / p->item_bytes;
    if (!count) return;
    uint8_t *bytes = (uint8_t *)p->bytes;
    memmove(bytes + sl_random_below(random, count) * p->item_bytes,
            bytes + sl_random_below(random, count) * p->item_bytes, p->item_bytes);
}

/// Moves a coordinate of the bounds or of the walls wherever it stands: what comes out may be
/// another sound space.
static void move_coordinate(parts *all, sl_random *random) {
    const bool bound = sl_random_below(random, 2);
    const part *some = find_part(all, bound ? "INFO" : "WALL");
    if (!some || some->size < 32) return;
    const uint64_t from = some->bytes[sl_random_below(random, bound ? 4 : some->size / 8)];
    double value;
    memcpy(&value, &from, sizeof value);
    value = sl_random_below(random, 2)
                ? odd_real(random)
                : value + (sl_random_unit(random) - 0.5) * (sl_random_below(random, 2) ? 1 : value);
    uint64_t to;
    memcpy(&to, &value, sizeof to);
    for (uint32_t i = 0; i < all->count; i++)
        for (size_t k = 0; k < all->part[i].size / 8; k++)
            if (all->part[i].bytes[k] == from) all->part[i].bytes[k] = to;
}

/// One section less, or one more of a kind.
static void change_sections(parts *all, sl_random *random) {
    part *chosen = &all->part[sl_random_below(random, all->count)];
    if (sl_random_below(random, 2) && all->count < MOST_PARTS)
        all->part[all->count++] = *chosen;
    else
        *chosen = all->part[--all->count];
}

/// Of the other version: a mesh's file becomes a loose one without a grid.
static void change_version(parts *all) {
    all->version = all->version == SLI_SLV_VERSION ? SLI_SLV_VERSION_AXIAL : SLI_SLV_VERSION;
}

/// Says that cells may overlap and leave gaps, so that corners can be moved and the file stays
/// sound.
static void make_loose(parts *all) {
    part *p = find_part(all, "INFO");
    if (!p || p->size != sizeof(sli_slv_info)) return;
    sli_slv_info info;
    memcpy(&info, p->bytes, sizeof info);
    info.loose = !info.loose;
    memcpy(p->bytes, &info, sizeof info);
}

static uint64_t count_pairs(parts *all, const char *offsets_tag, const char *bytes_tag) {
    part *offsets = find_part(all, offsets_tag), *bytes = find_part(all, bytes_tag);
    if (!offsets || !bytes || offsets->size < 16) return 0;
    const sl_pvs pvs = {.cell_count = (uint32_t)(offsets->size / 8 - 1),
                        .offsets = offsets->bytes,
                        .bytes = (uint8_t *)bytes->bytes};
    if (pvs.offsets[pvs.cell_count] != bytes->size) return 0;
    uint64_t pairs = 0;
    sl_context *context = fuzz_context();
    if (sli_pvs_check(context, &pvs) == SL_OK)
        for (uint32_t cell = 0; cell < pvs.cell_count; cell++) pairs += sl_pvs_count(&pvs, cell);
    sl_context_destroy(context);
    return pairs;
}

/// The number of pairs stands in the file twice.
static void recount_pairs(parts *all) {
    part *p = find_part(all, "INFO");
    if (!p || p->size != sizeof(sli_slv_info)) return;
    sli_slv_info info;
    memcpy(&info, p->bytes, sizeof info);
    info.pairs = count_pairs(all, "PVSO", "PVSB");
    info.doubtful_pairs = count_pairs(all, "DBTO", "DBTB");
    memcpy(p->bytes, &info, sizeof info);
}

/// What is told of the rows, likewise.
static void tell_parts_again(parts *all) {
    part *told = find_part(all, "PVSP"), *offsets = find_part(all, "PVSO");
    if (!told || !count_pairs(all, "PVSO", "PVSB") || told->size != offsets->size - 8) return;
    const sl_pvs pvs = {.cell_count = (uint32_t)(told->size / 8),
                        .offsets = offsets->bytes,
                        .bytes = (uint8_t *)find_part(all, "PVSB")->bytes};
    sli_pvs_parts(&pvs, told->bytes);
}

/// Without a section that few changed files could be right with.
static void leave_out(parts *all, const char *tag) {
    part *p = find_part(all, tag);
    if (p) *p = all->part[--all->count];
}

static void mutate_parts(parts *all, sl_random *random) {
    if (!all->count) return;
    part *chosen = &all->part[sl_random_below(random, all->count)];
    switch (sl_random_below(random, 9)) {
    case 0:
        change_sections(all, random);
        break;
    case 1:
        move_coordinate(all, random);
        break;
    case 2:
        copy_item(chosen, random);
        break;
    case 3:
        if (sl_random_below(random, 2))
            change_version(all);
        else
            make_loose(all);
        break;
    case 4:
    case 5:
        set_number(chosen, random);
        break;
    default:
        mutate_bytes(chosen);
    }
    if (sl_random_below(random, 8)) recount_pairs(all);
    if (sl_random_below(random, 8)) tell_parts_again(all);
    if (!sl_random_below(random, 8)) leave_out(all, "NODG"), leave_out(all, "NODS");
}

/// The file that the parts make; where they make none, what was there, mutated blindly.
static size_t finish(parts *all, uint8_t *data, size_t size, size_t max_size) {
    const size_t made = put_together(all, data, max_size);
    return made ? made : LLVMFuzzerMutate(data, size, max_size);
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed) {
    sl_random random = {seed};
    if (!is_baked(data, size) && sl_random_below(&random, 2)) {
        size_t baked_size = 0;
        char *bytes = baked_text(data, size, &baked_size);
        const bool fits = bytes && baked_size <= max_size;
        if (fits) memcpy(data, bytes, baked_size);
        free(bytes);
        if (fits) return baked_size;
    }
    parts *all = malloc(sizeof *all);
    FUZZ_CHECK(all);
    const bool blindly = !sl_random_below(&random, 32) || !take_apart(data, size, all);
    if (!blindly) mutate_parts(all, &random);
    size = blindly ? LLVMFuzzerMutate(data, size, max_size) : finish(all, data, size, max_size);
    // The header and the table of sections are blindly mutated too, some of them then sealed.
    if (blindly && is_baked(data, size) && sl_random_below(&random, 8)) {
        sli_slv_header header;
        memcpy(&header, data, sizeof header);
        seal(data, size, header.version, header.section_count);
    }
    free(all);
    return size;
}

size_t LLVMFuzzerCustomCrossOver(const uint8_t *data, size_t size, const uint8_t *other,
                                 size_t other_size, uint8_t *out, size_t max_size, unsigned seed) {
    sl_random random = {seed};
    parts *all = malloc(sizeof *all), *others = malloc(sizeof *others);
    FUZZ_CHECK(all && others);
    size_t made = 0;
    if (take_apart(data, size, all) && take_apart(other, other_size, others) && others->count) {
        const part *chosen = &others->part[sl_random_below(&random, others->count)];
        part *place = find_part(all, chosen->tag);
        if (place) *place = *chosen;
        recount_pairs(all);
        made = put_together(all, out, max_size);
    }
    free(all);
    free(others);
    return made;
}

#endif
