/// What the test programs share: a context whose allocator counts and can fail, and short cuts from
/// a map's text to a space.
#ifndef SL_TESTING_H
#define SL_TESTING_H

#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "map/scan.h"
#include "sightline/sightline.h"

/// An allocator that counts live blocks, of all threads, and can be told to fail from its Nth call
/// on (0: never), or at that call alone.
typedef struct testing_memory {
    atomic_long live, calls;
    long fail_at;
    bool once;
} testing_memory;

static inline void *testing_resize(void *user, void *block, size_t bytes) {
    testing_memory *memory = user;
    if (!bytes) {
        memory->live -= block != NULL;
        free(block);
        return NULL;
    }
    const long call = ++memory->calls;
    if (memory->once ? call == memory->fail_at : call >= memory->fail_at && memory->fail_at)
        return NULL;
    void *resized = realloc(block, bytes);
    memory->live += !block && resized;
    return resized;
}

static inline sl_context *testing_context(testing_memory *memory) {
    const sl_hooks hooks = {.user = memory, .resize = testing_resize};
    sl_context *context = sl_context_create(memory ? &hooks : NULL);
    assert_non_null(context);
    return context;
}

/// Fails the test with the context's message where a call failed.
#define assert_ok(context, call)                                                                   \
    do {                                                                                           \
        const sl_status testing_status = (call);                                                   \
        if (testing_status != SL_OK)                                                               \
            fail_msg("%s: %s (%s)", #call, sl_context_message(context),                            \
                     sl_status_name(testing_status));                                              \
    } while (0)

/// How many random inputs a test tries: as many as SIGHTLINE_SEEDS of the environment says, with
/// "/20" a twentieth of the usual number, else that number. Under a sanitizer each takes several
/// times as long: there it is a fifth. A smaller part is said.
static inline uint64_t testing_seeds(uint64_t usual) {
    const char *text = getenv("SIGHTLINE_SEEDS");
#ifdef SIGHTLINE_SANITIZED
    if (!text) text = "/5";
#endif
    const bool part = text && *text == '/';
    const uint64_t told = text ? strtoull(text + part, NULL, 10) : 0;
    if (!told) return usual;
    if (!part) return told;
    const uint64_t some = (usual + told - 1) / told;
    print_message("%llu of %llu random inputs\n", (unsigned long long)some,
                  (unsigned long long)usual);
    return some;
}

/// A method of cell-to-cell visibility by its name.
static inline const sl_see_method *testing_method(const char *name) {
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    for (size_t i = 0; i < count; i++)
        if (strcmp(methods[i].name, name) == 0) return &methods[i];
    fail_msg("no method '%s'", name);
    return NULL;
}

/// For hooks: cancelled from the start.
static inline bool testing_cancelled(void *user) {
    (void)user;
    return true;
}

static inline bool testing_same_point(sl_point a, sl_point b) {
    return a.x == b.x && a.y == b.y;
}

/// Whether visible sets are the same to the byte.
static inline bool testing_same_rows(const sl_pvs *a, const sl_pvs *b) {
    if (a->cell_count != b->cell_count) return false;
    if (!a->cell_count) return true;
    const size_t offsets = ((size_t)a->cell_count + 1) * sizeof *a->offsets;
    return memcmp(a->offsets, b->offsets, offsets) == 0 &&
           memcmp(a->bytes, b->bytes, a->offsets[a->cell_count]) == 0;
}

/// Cleans a map and cuts it as it calls for.
static inline void testing_subdivide(sl_context *context, sl_map *map, sl_space *space) {
    assert_ok(context, sl_map_clean(context, map, NULL, NULL));
    assert_ok(context, sl_subdivision_for(map)->subdivide(context, map, NULL, space));
}

/// Gives cells that were cut anew, within those of a space, what these say of inside: boxes' sides
/// enclose nothing.
static inline void testing_take_inside(const sl_space *from, sl_space *cut) {
    for (uint32_t i = 0; i < cut->cell_count; i++) {
        const uint32_t cell = sl_space_locate(from, sl_space_middle(cut, i));
        cut->cells[i].inside = cell != SL_NO_CELL && from->cells[cell].inside;
    }
}

/// A cleaned map and its space, from map text without its first line.
static inline void testing_space(sl_context *context, const char *statements, sl_map *map,
                                 sl_space *space) {
    const size_t length = strlen(statements) + 32;
    char *text = malloc(length);
    assert_non_null(text);
    snprintf(text, length, "sightline 1\n%s", statements);
    assert_ok(context, sli_map_read_text(context, "test", text, strlen(text), map));
    free(text);
    testing_subdivide(context, map, space);
}

#endif
