// Hostile baked files for the runtime: small files of every kind are changed in their fields, cut,
// lengthened, their tables shuffled, and sealed with the right checksum again; then each is opened,
// and every function of the runtime is called on those that open. A plain program, thousands of
// files a second: for millions of them, built with the address sanitizer.
//
//     hostile_slv [--count N] [--seconds S] [--seed N] [--quiet]
#include "runtime_calls.h"

#include "bake/slv.h"
#include "baked_bytes.h"
#include "map/scan.h"
#include "sightline/bake.h"
#include "sightline/stab.h"

#include <zlib.h>

enum { KINDS = 16, MOST_SIZE = 1 << 14 };

typedef struct original {
    uint8_t *bytes;
    size_t size;
} original;

static original originals[KINDS];
static size_t original_count;

static void keep(sl_context *context, const sl_baked *baked) {
    size_t size;
    char *bytes = baked_bytes(context, baked, &size);
    FUZZ_CHECK(size < MOST_SIZE && original_count < KINDS);
    originals[original_count++] = (original){(uint8_t *)bytes, size};
}

/// Each cell a view cell of its own; beside the rows of cells, or in their place.
static void keep_views(sl_context *context, sl_baked *baked) {
    const uint32_t count = baked->space.cell_count;
    uint32_t *own = room(count * sizeof *own), *none = room(count * sizeof *none);
    for (uint32_t i = 0; i < count; i++) own[i] = i, none[i] = SL_RUNTIME_NO_CELL;
    baked->views = (sl_view_rows){count, count, own, none, baked->visibility.pvs};
    keep(context, baked);
    baked->by_views = true;
    baked->visibility.guarantee = SL_CONSERVATIVE;
    keep(context, baked);
    baked->views = (sl_view_rows){0};
    free(own);
    free(none);
}

static void bake_text(const char *statements, bool mesh, bool views) {
    char text[512];
    sl_context *context = fuzz_context();
    sl_map map = {0};
    sl_baked baked = {0};
    snprintf(text, sizeof text, "sightline 1\n%s", statements);
    FUZZ_CHECK(sli_map_read_text(context, "input", text, strlen(text), &map) == SL_OK);
    sl_bake_options options = sl_bake_options_default();
    options.see.threads = 1;
    size_t count;
    const sl_subdivision *subdivisions = sl_subdivisions(&count);
    for (size_t i = 0; i < count && mesh; i++)
        if (strcmp(subdivisions[i].name, "mesh") == 0) options.subdivision = &subdivisions[i];
    FUZZ_CHECK(sl_bake(context, &map, &options, &baked, NULL) == SL_OK);
    keep(context, &baked);
    if (views) keep_views(context, &baked);
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
}

static void make_originals(void) {
    bake_text("wall 0 0 4 0\nwall 0 3 4 3\n", false, true);
    bake_text("wall 0 0 4 0\nwall 0 3 4 3\n", true, true);
    bake_text("walls 0 0 9 0 9 9 0 9 0 0\nwall 4 0 4 5\nstart 1 1 45\nrange 7.5\n", false, false);
    bake_text("walls 0 0 9 0 9 9 0 9 0 0\nwall 4 2 5 5\nstart 1 1 -1e-3\n", true, false);
    bake_text("walls 0 0 9 0 9 4 0 4 0 0\nwall 4 0 4 1\ndoor a 4 1 4 4 open\nstart 1 1 0\n", false,
              false);
    bake_text("walls 0 0 9 0 9 4 0 4 0 0\nwall 4 0 5 1\ndoor a 5 1 4 4 shut\ndoor b 7 0 7 4 open\n",
              true, false);
    bake_text("walls 0 0 9 0 9 4 0 4 0 0\noneway 4 4 4 0\nmirror 0 0 0 4\nseam 6 0 6 4\n"
              "object crate 1 1 2 2\npath way 1 1 2 2\npath back 2 2\n",
              false, false);
    bake_text("walls 0 0 9 0 9 4 0 4 0 0\nwall 4 0 4 2 stops sight\nwall 4 1 4 4 stops sound\n"
              "wall 6 1 6 4 stops steps\nsolid 1 1 2 1 2 2 1 2 stops steps\n",
              false, false);
    bake_text(
        "walls 0 0 9 0 9 4 0 4 0 0\nwall 4 0 5 4 stops sight,sound\nwall 6 1 5 4 stops steps\n",
        true, false);
}

// --- changes

static void put(uint8_t *at, const void *value, size_t size) {
    memcpy(at, value, size);
}

/// Where the entry of some section is in the table, and that entry.
static size_t some_entry(const uint8_t *bytes, size_t size, sl_random *random,
                         sli_slv_section *out) {
    sli_slv_header header;
    memcpy(&header, bytes, sizeof header);
    const size_t most = (size - sizeof header) / sizeof *out;
    const size_t count = header.section_count < most ? header.section_count : most;
    const size_t at = sizeof header + (count ? sl_random_below(random, count) : 0) * sizeof *out;
    if (at + sizeof *out > size) return 0;
    memcpy(out, bytes + at, sizeof *out);
    return at;
}

/// A field of some section: a number near the old one, an odd one, or a bit.
static void change_field(uint8_t *bytes, size_t size, sl_random *random) {
    sli_slv_section s;
    if (!some_entry(bytes, size, random, &s) || s.offset >= size) return;
    uint64_t long_size = s.count * s.item_bytes;
    if (long_size > size - s.offset) long_size = size - s.offset;
    if (!long_size) return;
    uint8_t *at = bytes + s.offset + sl_random_below(random, long_size);
    const size_t room_left = (size_t)(bytes + s.offset + long_size - at);
    switch (sl_random_below(random, 6)) {
    case 0:
        *at = (uint8_t)sl_random_below(random, 256);
        return;
    case 1:
        *at ^= (uint8_t)(1u << sl_random_below(random, 8));
        return;
    case 2:
        *at = (uint8_t)(*at + (sl_random_below(random, 2) ? 1 : -1));
        return;
    default:
        break;
    }
    // Fields lie at multiples of their size, from the start of the section on.
    at -= (size_t)(at - bytes - s.offset) % (s.item_bytes % 8 ? 4 : 8);
    if (s.item_bytes % 4 || room_left < 8) return;
    const double real = odd_real(random);
    uint32_t count;
    memcpy(&count, at, sizeof count);
    count = sl_random_below(random, 2) ? odd_count(random) : count + odd_count(random);
    if (sl_random_below(random, 2))
        put(at, &count, sizeof count);
    else
        put(at, &real, sizeof real);
}

/// A field of the table: another tag, size, place or count; or one entry over another.
static void change_table(uint8_t *bytes, size_t size, sl_random *random) {
    sli_slv_section s, other;
    const size_t at = some_entry(bytes, size, random, &s);
    if (!at || !some_entry(bytes, size, random, &other)) return;
    const uint64_t far = UINT64_MAX - sl_random_below(random, 64);
    switch (sl_random_below(random, 8)) {
    case 0:
        memcpy(s.tag, other.tag, sizeof s.tag);
        break;
    case 1:
        s.item_bytes = odd_count(random);
        break;
    case 2:
        s.offset += sl_random_below(random, 64) - 32;
        break;
    case 3:
        s.count += sl_random_below(random, 8) - 4;
        break;
    case 4:
        s.count = sl_random_below(random, 2) ? far : far / 8;
        break;
    case 5:
        s.offset = sl_random_below(random, 2) ? far : size - sl_random_below(random, 16);
        break;
    case 6:
        s.offset = other.offset;
        break;
    default:
        s = other;
    }
    put(bytes + at, &s, sizeof s);
}

/// Bytes of one place over those of another: numbers that make sense, elsewhere.
static void copy_bytes(uint8_t *bytes, size_t size, sl_random *random) {
    const size_t length = 4u << sl_random_below(random, 4), from = sizeof(sli_slv_header);
    if (size < from + length + 8) return;
    const size_t places = (size - from - length) / 4;
    memmove(bytes + from + 4 * sl_random_below(random, places),
            bytes + from + 4 * sl_random_below(random, places), length);
}

static size_t change_size(uint8_t *bytes, size_t size, sl_random *random) {
    const size_t by = sl_random_below(random, 64);
    if (sl_random_below(random, 2)) return size > by ? size - by : size;
    if (size + by > MOST_SIZE) return size;
    memset(bytes + size, (int)sl_random_below(random, 256), by);
    return size + by;
}

static size_t change(uint8_t *bytes, size_t size, sl_random *random) {
    switch (sl_random_below(random, 16)) {
    case 0:
        return change_size(bytes, size, random);
    case 1:
    case 2:
        change_table(bytes, size, random);
        return size;
    case 3:
        copy_bytes(bytes, size, random);
        return size;
    case 4:
        if (size)
            bytes[sl_random_below(random, size)] ^= (uint8_t)(1u << sl_random_below(random, 8));
        return size;
    default:
        change_field(bytes, size, random);
        return size;
    }
}

/// The size, the byte order and the checksum are made right; the version may become the other one.
static void seal(uint8_t *bytes, size_t size, sl_random *random) {
    sli_slv_header header;
    if (size < sizeof header) return;
    memcpy(&header, bytes, sizeof header);
    memcpy(header.magic, SLI_SLV_MAGIC, sizeof header.magic);
    header.byte_order = SLI_SLV_BYTE_ORDER;
    header.file_bytes = size;
    if (!sl_random_below(random, 32))
        header.version =
            header.version == SLI_SLV_VERSION ? SLI_SLV_VERSION_AXIAL : SLI_SLV_VERSION;
    header.checksum = 0;
    memcpy(bytes, &header, sizeof header);
    header.checksum = (uint32_t)crc32(0, bytes, (uInt)size);
    memcpy(bytes, &header, sizeof header);
}

// --- the run

typedef struct tally {
    uint64_t count, by_status[SL_RUNTIME_TEXT + 1];
} tally;

static void try_file(uint64_t seed, tally *t) {
    sl_random random = {seed};
    uint8_t bytes[MOST_SIZE];
    const original *o = &originals[sl_random_below(&random, original_count)];
    size_t size = o->size;
    memcpy(bytes, o->bytes, size);
    for (uint64_t i = sl_random_below(&random, 4) + 1; i > 0; i--)
        size = change(bytes, size, &random);
    if (sl_random_below(&random, 64)) seal(bytes, size, &random);
    // A block of its own: what is read beyond its end is found out. At any alignment.
    const size_t shift = seed % 8;
    uint8_t *block = room(size + shift);
    memcpy(block + shift, bytes, size);
    sl_runtime r = {0};
    const sl_runtime_status status = sl_runtime_open(block + shift, size, &r);
    FUZZ_CHECK((unsigned)status <= SL_RUNTIME_TEXT && *sl_runtime_status_text(status));
    if (status == SL_RUNTIME_OK) check_open(&r, 0, &random);
    FUZZ_CHECK(memcmp(block + shift, bytes, size) == 0);
    free(block);
    t->count++;
    t->by_status[status]++;
}

int main(int argc, char **argv) {
    uint64_t seed = 1, count = 100000;
    double seconds = 0;
    bool quiet = false;
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--quiet") == 0) {
            quiet = true;
        } else if (i + 1 < argc && strcmp(argv[i], "--seed") == 0) {
            seed = strtoull(argv[++i], NULL, 10);
        } else if (i + 1 < argc && strcmp(argv[i], "--count") == 0) {
            count = strtoull(argv[++i], NULL, 10);
        } else if (i + 1 < argc && strcmp(argv[i], "--seconds") == 0) {
            seconds = strtod(argv[++i], NULL);
        } else {
            fputs("usage: hostile_slv [--count N] [--seconds S] [--seed N] [--quiet]\n", stderr);
            return 2;
        }
    }
    make_originals();
    tally t = {0};
    const double start = sl_seconds();
    // Where the run ends by a fault, the seed of its file is said.
    for (; t.count < count && (seconds <= 0 || sl_seconds() - start < seconds); seed++) {
        if (!quiet && seed % 100000 == 0) {
            printf("seed %llu\n", (unsigned long long)seed);
            fflush(stdout);
        }
        try_file(seed, &t);
    }
    const double took = sl_seconds() - start;
    if (!quiet) printf("%llu files in %.0f s\n", (unsigned long long)t.count, took);
    for (int i = 0; i <= SL_RUNTIME_TEXT && !quiet; i++)
        printf("%10llu  %s\n", (unsigned long long)t.by_status[i],
               sl_runtime_status_text((sl_runtime_status)i));
    // Too few that open: nothing was tried.
    FUZZ_CHECK(t.by_status[SL_RUNTIME_OK] > t.count / 20);
    for (size_t i = 0; i < original_count; i++) free(originals[i].bytes);
    return 0;
}
