/// A call whose memory fails once: at its Nth allocation, or from there on. For each N the call
/// must say so and leave nothing behind, or do without that block and give what it gives otherwise.
/// A failure that is overlooked shows as a crash, a leak, or another result.
///
/// A call that needs n allocations is run about 2n times; so maps are small. By default at most
/// ONE_FAILURE_TRIES values of N are tried for a call, spread evenly; SIGHTLINE_EVERY=1 in the
/// environment tries each.
#ifndef SL_ONE_FAILURE_H
#define SL_ONE_FAILURE_H

#include "testing.h"

#include "baked_bytes.h"
#include "map/scan.h"
#include "sightline/bake.h"
#include "sightline/io.h"
#include "sightline/support.h"

#include <limits.h>

#ifdef SIGHTLINE_SANITIZED
enum { ONE_FAILURE_TRIES = 25 };
#else
enum { ONE_FAILURE_TRIES = 300 };
#endif

/// What calls work on: made by whoever runs them, and the same before and after each call.
typedef struct one_failure {
    testing_memory memory;
    sl_map read, map; ///< as read, and clean
    sl_baked baked;
    uint64_t digest; ///< of what the call has given
    long needed;     ///< allocations that the call has made
} one_failure;

/// Leaves nothing that it has made.
typedef sl_status one_failure_call(sl_context *context, one_failure *on);

typedef struct one_failure_row {
    const char *name;
    one_failure_call *call;
} one_failure_row;

/// Memory holds from here on: what follows looks at the result.
static inline void one_failure_ends(one_failure *on) {
    if (on->memory.fail_at != LONG_MAX) on->needed = on->memory.calls;
    on->memory.fail_at = LONG_MAX;
}

static inline void one_failure_mix(one_failure *on, const void *bytes, size_t size) {
    const unsigned char *at = bytes;
    for (size_t i = 0; i < size; i++) on->digest = (on->digest ^ at[i]) * 1099511628211u;
}

/// All that a baked file holds.
static inline void one_failure_mix_baked(sl_context *context, one_failure *on,
                                         const sl_baked *baked) {
    size_t size;
    char *bytes = baked_bytes(context, baked, &size);
    one_failure_mix(on, bytes, size);
    free(bytes);
}

/// Visible sets over the space of the baked file.
static inline void one_failure_mix_seen(sl_context *context, one_failure *on,
                                        const sl_visibility *seen) {
    sl_baked baked = on->baked;
    baked.visibility = *seen;
    baked.views = (sl_view_rows){0};
    baked.by_views = false;
    one_failure_mix_baked(context, on, &baked);
}

/// Runs a call once, failing at allocation `at` alone or from there on; never where `at` is 0.
static inline sl_status one_failure_run(sl_context *context, one_failure *on,
                                        const one_failure_row *row, long at, bool once) {
    const long live = on->memory.live;
    on->digest = 14695981039346656037u;
    on->memory.calls = 0;
    on->memory.once = once;
    on->memory.fail_at = at ? at : LONG_MAX - 1;
    const sl_status status = row->call(context, on);
    one_failure_ends(on);
    if (on->memory.live != live)
        fail_msg("%s leaves %ld blocks when allocation %ld fails", row->name,
                 on->memory.live - live, at);
    return status;
}

static inline void one_failure_check(sl_context *context, one_failure *on,
                                     const one_failure_row *row) {
    const sl_status usual = one_failure_run(context, on, row, 0, false);
    if (usual != SL_OK && usual != SL_UNSUPPORTED)
        fail_msg("%s: %s", row->name, sl_context_message(context));
    const uint64_t digest = on->digest;
    const long needed = on->needed;
    const bool every = getenv("SIGHTLINE_EVERY") != NULL;
    const long step = every || needed <= ONE_FAILURE_TRIES ? 1 : needed / ONE_FAILURE_TRIES;
    long refused = 0, tries = 0;
    for (long at = 1; at <= needed; at += step)
        for (int once = 0; once < 2; once++, tries++) {
            const sl_status status = one_failure_run(context, on, row, at, once);
            refused += status == SL_NO_MEMORY;
            if (status == SL_NO_MEMORY) {
                assert_string_equal(sl_context_message(context), "out of memory");
            } else if (status != usual || on->digest != digest) {
                fail_msg("%s: '%s' when allocation %ld of %ld fails%s, and another result",
                         row->name, sl_status_name(status), at, needed, once ? " alone" : "");
            }
        }
    // What it works on is as it was.
    assert_int_equal(one_failure_run(context, on, row, 0, false), usual);
    assert_true(on->digest == digest);
    if (usual == SL_OK && needed && !refused) fail_msg("%s needs no memory", row->name);
    if (every)
        print_message("  %s (%s): %ld allocations, %ld runs, %ld refused\n", row->name,
                      sl_status_name(usual), needed, tries, refused);
}

/// A map from text without its first line, cleaned, cut and looked from.
static inline void one_failure_begin(sl_context *context, one_failure *on, const char *statements) {
    char text[2048];
    assert_ok(context, sl_io_use(context));
    snprintf(text, sizeof text, "sightline 1\n%s", statements);
    assert_ok(context, sli_map_read_text(context, "text", text, strlen(text), &on->read));
    assert_ok(context, sl_map_copy(context, &on->read, &on->map));
    assert_ok(context, sl_map_clean(context, &on->map, NULL, NULL));
    sl_map map = {0};
    assert_ok(context, sl_map_copy(context, &on->read, &map));
    sl_bake_options options = sl_bake_options_default();
    options.see.threads = 1;
    assert_ok(context, sl_bake(context, &map, &options, &on->baked, NULL));
}

static inline void one_failure_end(sl_context *context, one_failure *on) {
    sl_baked_destroy(context, &on->baked);
    sl_map_destroy(context, &on->map);
    sl_map_destroy(context, &on->read);
}

/// Checks each call of a table on a map.
static inline void one_failure_check_all(const char *statements, const one_failure_row *rows,
                                         size_t count) {
    one_failure on = {.memory = {.fail_at = LONG_MAX}};
    sl_context *context = testing_context(&on.memory);
    one_failure_begin(context, &on, statements);
    for (size_t i = 0; i < count; i++) one_failure_check(context, &on, &rows[i]);
    one_failure_end(context, &on);
    sl_context_destroy(context);
    assert_int_equal(on.memory.live, 0);
}

#endif
