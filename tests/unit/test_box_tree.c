// The tree of boxes finds what asking all boxes finds: of random ones, of many in one place, of
// points and lines, tiny, huge and without end.
#include "testing.h"

#include "sightline/support.h"
#include "space/index.h"

#include <math.h>

enum { MOST = 3000, QUESTIONS = 200 };

/// A kind of boxes: where they are and how large.
typedef struct kind {
    double origin, span, size;
    bool snaps; ///< to few coordinates, so that many touch or are the same
} kind;

static double draw(sl_random *random, double most, bool snaps) {
    const double at = sl_random_unit(random) * most;
    return snaps && most > 0 ? floor(at / most * 16) * most / 16 : at;
}

static sl_box draw_box(sl_random *random, const kind *k) {
    sl_box box;
    box.min.x = k->origin + draw(random, k->span, k->snaps);
    box.min.y = k->origin + draw(random, k->span, k->snaps);
    const uint64_t shape = sl_random_below(random, 4);
    box.max.x = box.min.x + (shape & 1 ? draw(random, k->size, k->snaps) : 0);
    box.max.y = box.min.y + (shape & 2 ? draw(random, k->size, k->snaps) : 0);
    return box;
}

static void ask(sl_context *context, const sli_box_tree *tree, const sl_box *boxes, size_t count,
                const sl_box *question, sli_box_list *found) {
    assert_ok(context, sli_box_tree_find(context, tree, question, found));
    size_t next = 0;
    for (size_t i = 0; i < count; i++) {
        const sl_box *b = &boxes[i];
        const bool apart = b->max.x < question->min.x || b->min.x > question->max.x ||
                           b->max.y < question->min.y || b->min.y > question->max.y;
        if (apart) continue;
        assert_true(next < found->count);
        assert_int_equal(found->items[next++], i);
    }
    assert_int_equal(next, found->count);
}

static void check_kind(const kind *k, size_t count) {
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_random random = {count};
    sl_box *boxes = malloc((count + 1) * sizeof *boxes);
    assert_non_null(boxes);
    for (size_t i = 0; i < count; i++) boxes[i] = draw_box(&random, k);
    sli_box_tree tree;
    assert_ok(context, sli_box_tree_create(context, boxes, count, &tree));
    sli_box_list found = {0};
    for (int i = 0; i < QUESTIONS; i++) {
        sl_box question = draw_box(&random, k);
        if (i % 4 == 1) question.max.x = HUGE_VAL;
        if (i % 4 == 2) question.min.y = -HUGE_VAL;
        ask(context, &tree, boxes, count, &question, &found);
    }
    const sl_box all = {{-HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, HUGE_VAL}};
    ask(context, &tree, boxes, count, &all, &found);
    assert_int_equal(found.count, count);
    sl_free(context, found.items);
    sli_box_tree_destroy(context, &tree);
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
    free(boxes);
}

static void finds_what_asking_all_finds(void **state) {
    (void)state;
    const kind kinds[] = {
        {0, 100, 10, false},      {-50, 100, 60, true},       {7, 0x1p-40, 0, true},
        {1e15, 1024, 512, false}, {0, 1e-150, 1e-150, false}, {-1e150, 1.5e150, 1e150, false},
    };
    const size_t counts[] = {0, 1, 2, 7, 8, 9, 64, 65, 511, 513, MOST};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        for (size_t k = 0; k < sizeof counts / sizeof *counts; k++)
            check_kind(&kinds[i], counts[k]);
}

/// Every allocation that fails is told, and nothing is left behind.
static void survives_a_lack_of_memory(void **state) {
    (void)state;
    const sl_box boxes[20] = {{{0, 0}, {1, 1}}};
    for (long fail_at = 1; fail_at <= 4; fail_at++) {
        testing_memory memory = {.fail_at = fail_at + 1};
        sl_context *context = testing_context(&memory);
        sli_box_tree tree;
        sli_box_list found = {0};
        sl_status status = sli_box_tree_create(context, boxes, 20, &tree);
        if (status == SL_OK) status = sli_box_tree_find(context, &tree, &boxes[0], &found);
        assert_int_equal(status, SL_NO_MEMORY);
        sl_free(context, found.items);
        sli_box_tree_destroy(context, &tree);
        sl_context_destroy(context);
        assert_int_equal(memory.live, 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finds_what_asking_all_finds),
        cmocka_unit_test(survives_a_lack_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
