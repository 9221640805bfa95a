/// The lesson: a search or a subdivision step by step, each step in a sentence with its line of
/// pseudo-code; and the lines through the portal sequence at hand.
#ifndef VIEWER_LESSON_H
#define VIEWER_LESSON_H

#include "document.h"
#include "sightline/dual.h"
#include "sightline/steps.h"

typedef enum sl_subject { SL_SUBJECT_SEARCH, SL_SUBJECT_SUBDIVISION } sl_subject;

enum { SL_SENTENCE = 512 };

/// Zeroed to start.
typedef struct sl_lesson {
    sl_subject subject;
    bool made;
    uint32_t version, source; ///< what was recorded: of which document, from which cell
    sl_steps steps;
    size_t node_count; ///< splits of the subdivision
    size_t at;         ///< the step shown
    bool plays;
    double waited;
    /// The portals of the sequence at hand; their ends may have been dragged.
    sl_portal_ends ends[SL_DUAL_PORTALS_MOST];
    uint32_t end_count;
    bool dragged;         ///< ends are not where the map has them
    sl_dual dual, before; ///< with all portals, and without the last
    sl_dual_line line;    ///< the one chosen
} sl_lesson;

/// Records anew where the document, the source or the subject are others.
sl_status sl_lesson_update(sl_context *context, sl_lesson *lesson, const sl_document *document,
                           uint32_t source);
void sl_lesson_destroy(sl_context *context, sl_lesson *lesson);

size_t sl_lesson_length(const sl_lesson *lesson);
/// Shows a step; beyond the ends the first or the last.
void sl_lesson_go(sl_lesson *lesson, const sl_document *document, size_t step);
/// Plays on.
void sl_lesson_tick(sl_lesson *lesson, const sl_document *document, double seconds);

/// An end was dragged: what follows from it.
void sl_lesson_refresh(sl_lesson *lesson);

void sl_lesson_sentence(const sl_lesson *lesson, const sl_document *document,
                        char text[SL_SENTENCE]);
/// The pseudo-code, and which of its lines the step is at.
const char *const *sl_lesson_code(const sl_lesson *lesson, const sl_document *document,
                                  size_t *count);
size_t sl_lesson_code_line(const sl_lesson *lesson);

#endif
