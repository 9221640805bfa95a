/// A triangulation in the making (triangulation.c), and one that changes (triangulation_edit.c).
///
/// What changes is written word by word. A journal keeps the word that was there, so that an edit
/// that fails can be undone, and so that it is known afterwards which triangles are new.
#ifndef SL_SPACE_TRIANGULATOR_H
#define SL_SPACE_TRIANGULATOR_H

#include "sightline/support.h"
#include "space/mesh.h"

/// What a word of a triangulation is. The free lists are chains through `next` and `out`.
typedef enum sli_word_kind {
    SLI_WORD_FROM,      ///< of a half-edge; UINT32_MAX for one of a free edge
    SLI_WORD_NEXT,      ///< of a half-edge
    SLI_WORD_LABEL,     ///< of an edge
    SLI_WORD_OUT,       ///< of a point
    SLI_WORD_FREE_EDGE, ///< 1 + the first free edge, 0 for none
    SLI_WORD_FREE_POINT ///< 1 + the first free point, 0 for none
} sli_word_kind;

/// A word that was replaced.
typedef struct sli_written {
    sli_word_kind kind;
    uint32_t index, old;
} sli_written;

typedef struct sli_triangulator {
    sl_context *context;
    sli_triangulation *t;
    double scale;  ///< distances in the box, times scale, are at most 1
    uint32_t last; ///< a half-edge where walks start
    sl_random random;
    SL_ARRAY(uint32_t) doubtful; ///< half-edges that may need a flip
    SL_ARRAY(uint32_t) crossing;
    SL_ARRAY(uint32_t) flipped;
    uint32_t free_edge, free_point;
    bool keeps_journal;
    SL_ARRAY(sli_written) journal;
    size_t old_halves, old_points; ///< how many there were when the journal began
    uint32_t old_last;
    SL_ARRAY(uint32_t) ring; ///< of a point that is removed
} sli_triangulator;

/// The scale for a box.
double sli_triangulator_scale(const sl_box *box);
/// Frees what belongs to it; the triangulation stays.
void sli_triangulator_end(sli_triangulator *m);

/// More words than one step writes.
enum { SLI_WORDS_OF_STEP = 64 };

/// Makes room in the journal for the words of one step.
static inline sl_status sli_triangulator_room(sli_triangulator *m) {
    return m->keeps_journal ? SL_ARRAY_ROOM(m->context, &m->journal, SLI_WORDS_OF_STEP) : SL_OK;
}

static inline uint32_t *sli_triangulator_word(sli_triangulator *m, sli_word_kind kind,
                                              uint32_t index) {
    switch (kind) {
    case SLI_WORD_FROM:
        return &m->t->halves.items[index].from;
    case SLI_WORD_NEXT:
        return &m->t->halves.items[index].next;
    case SLI_WORD_LABEL:
        return &m->t->labels[index];
    case SLI_WORD_OUT:
        return &m->t->out[index];
    case SLI_WORD_FREE_EDGE:
        return &m->free_edge;
    case SLI_WORD_FREE_POINT:
        break;
    }
    return &m->free_point;
}

/// Writes a word. There must be room in the journal.
static inline void sli_triangulator_put(sli_triangulator *m, sli_word_kind kind, uint32_t index,
                                        uint32_t value) {
    uint32_t *word = sli_triangulator_word(m, kind, index);
    if (m->keeps_journal) m->journal.items[m->journal.count++] = (sli_written){kind, index, *word};
    *word = value;
}

/// Makes a triangle of three half-edges.
static inline void sli_triangulator_link(sli_triangulator *m, uint32_t a, uint32_t b, uint32_t c) {
    sli_triangulator_put(m, SLI_WORD_NEXT, a, b);
    sli_triangulator_put(m, SLI_WORD_NEXT, b, c);
    sli_triangulator_put(m, SLI_WORD_NEXT, c, a);
}

/// A half-edge of the triangle that holds a point within the box, by a walk from `last`. If the
/// point is on an edge, it is that edge, and *on is true.
uint32_t sli_triangulator_walk(sli_triangulator *m, sl_point p, bool *on);

/// Adds a point of the triangulation, which is not in a triangle yet, and is on no edge of the
/// graph.
sl_status sli_triangulator_add_point(sli_triangulator *m, uint32_t point);
/// Makes the way between two points an edge with a label. SL_BAD_INPUT where it crosses or touches
/// another one.
sl_status sli_triangulator_add_edge(sli_triangulator *m, uint32_t a, uint32_t b, uint32_t label);
/// Lists an edge as one that may need a flip.
sl_status sli_triangulator_doubt(sli_triangulator *m, uint32_t half);
/// Flips doubtful edges until none needs it.
sl_status sli_triangulator_settle(sli_triangulator *m);

// --- changes (triangulation_edit.c)

/// Begins a journal.
void sli_triangulator_begin(sli_triangulator *m);
/// A point of the triangulation, for sli_triangulator_add_point.
sl_status sli_triangulator_new_point(sli_triangulator *m, sl_point at, uint32_t *out);
/// Removes a point within the box that no labelled edge ends at.
sl_status sli_triangulator_remove_point(sli_triangulator *m, uint32_t point);
/// Takes the label off an edge.
sl_status sli_triangulator_unlabel(sli_triangulator *m, uint32_t edge);
/// The half-edge from a point to another one; SLI_OUTSIDE for none.
uint32_t sli_triangulator_half(const sli_triangulation *t, uint32_t a, uint32_t b);
/// Puts back all words of the journal, and empties it.
void sli_triangulator_undo(sli_triangulator *m);

/// The next half-edge that starts in the same point, counter-clockwise; SLI_OUTSIDE behind the last
/// one at a point of the border.
static inline uint32_t sli_half_around(const sli_triangulation *t, uint32_t half) {
    const sli_half_edge *halves = t->halves.items;
    return halves[half].next == SLI_OUTSIDE ? SLI_OUTSIDE : halves[halves[half].next].next ^ 1;
}

#endif
