/// The lesson: a search, a subdivision or the passes of multipass step by step, each step in a
/// sentence with its line of pseudo-code; and the lines through the portal sequence at hand.
#ifndef VIEWER_LESSON_H
#define VIEWER_LESSON_H

#include "cell_to_cell/sectors.h"
#include "document.h"
#include "draw/canvas.h"
#include "sightline/dual.h"
#include "sightline/steps.h"
#include "sightline/support.h"
#include "space/mesh_steps.h"

typedef struct sl_app sl_app;
typedef struct sl_lesson sl_lesson;

enum { SL_SENTENCE = 512, SL_PASSES = 4 };

/// A subject: one file (lesson_search.c, lesson_subdivision.c, ...) and one row of the
/// table in lesson.c. Its record stands in sl_lesson. Functions behind `code` may be NULL. All but
/// the first two are asked only while there is a step: at < length.
typedef struct sl_subject {
    const char *title;
    bool (*fits)(const sl_document *document); ///< whether it has a place there; NULL: always
    bool of_eye; ///< recorded anew where the eye's cell is another; needs one
    /// Records all steps. What is recorded goes with sl_lesson_forget().
    sl_status (*record)(sl_context *context, sl_lesson *lesson, const sl_document *document,
                        uint32_t source);
    size_t (*length)(const sl_lesson *lesson);
    void (*sentence)(const sl_lesson *lesson, const sl_document *document, char text[SL_SENTENCE]);
    /// The pseudo-code; *lit is the line that the step is at.
    const char *const *(*code)(const sl_lesson *lesson, const sl_document *document, size_t *count,
                               size_t *lit);
    /// What has been found so far, in a sentence.
    void (*account)(const sl_lesson *lesson, char text[SL_SENTENCE]);
    /// The portals of the step's sequence, into lesson->ends; for subjects that have one. Its lines
    /// are then shown in the dual plane and can be dragged.
    uint32_t (*sequence)(const sl_lesson *lesson, const sl_space *space, sl_portal_ends *ends);
    void (*below)(sl_app *app, const sl_frame *frame); ///< drawn below the walls
    void (*above)(sl_app *app, const sl_frame *frame); ///< and above them
} sl_subject;

extern const sl_subject sl_lesson_search, sl_lesson_subdivision, sl_lesson_pass, sl_lesson_effects;

/// All subjects.
const sl_subject *const *sl_subjects(size_t *count);

/// What there is to say of a pair of cells, as was baked.
typedef enum sl_effect_fact {
    SL_FACT_SEEN,    ///< past walls alone
    SL_FACT_SEES,    ///< likewise, and not the other way
    SL_FACT_DOORS,   ///< while some doors are open
    SL_FACT_MIRROR,  ///< by mirror alone
    SL_FACT_WATCHED, ///< not, but the other way
    SL_FACT_DARK,    ///< not, for glass
    SL_FACT_RANGE,   ///< not, for the range (or glass, where there is any)
    SL_FACT_NONE,    ///< not, for walls
} sl_effect_fact;

typedef struct sl_effect_step {
    uint32_t cell;
    sl_effect_fact fact;
    size_t entry; ///< of lesson->steps, where a search of walls alone enters it; 0 for none
} sl_effect_step;

/// Zeroed to start.
struct sl_lesson {
    size_t subject; ///< of the table
    bool made;
    uint32_t version, source; ///< what was recorded: of which document, from which cell
    sl_steps steps;           ///< of the search
    SL_ARRAY(sl_effect_step) effects;
    size_t subdivision_steps;
    sl_mesh_steps mesh;        ///< of the subdivision, where it is a mesh
    sl_pass passes[SL_PASSES]; ///< of multipass, by quadrant
    uint32_t pass_cells;
    size_t at; ///< the step shown
    bool plays;
    double waited;
    /// The portals of the sequence at hand; their ends may have been dragged.
    sl_portal_ends ends[SL_DUAL_PORTALS_MOST];
    uint32_t end_count;
    bool dragged;         ///< ends are not where the map has them
    sl_dual dual, before; ///< with all portals, and without the last
    sl_dual_line line;    ///< the one chosen
};

const sl_subject *sl_lesson_subject(const sl_lesson *lesson);
/// The next subject that has a place; it is recorded by the next update.
void sl_lesson_change(sl_context *context, sl_lesson *lesson, const sl_document *document);
/// Whether there is a step to show of the document as it is.
bool sl_lesson_shows(const sl_lesson *lesson, const sl_document *document);

/// Records anew where the document, the source or the subject are others.
sl_status sl_lesson_update(sl_context *context, sl_lesson *lesson, const sl_document *document,
                           uint32_t source);
/// Drops what is recorded.
void sl_lesson_forget(sl_context *context, sl_lesson *lesson);
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

#endif
