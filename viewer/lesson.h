/// The lesson shows a search, a subdivision or the passes of multipass step by step. Each step is a
/// sentence with a line of pseudo-code. The lines through the portal sequence of the step can be
/// dragged.
#ifndef VIEWER_LESSON_H
#define VIEWER_LESSON_H

#include "cell_to_cell/sectors.h" // private: lessons show the inside of the library
#include "document.h"
#include "sightline/canvas.h"
#include "sightline/dual.h"
#include "sightline/steps.h"
#include "sightline/support.h"
#include "space/mesh.h" // private, likewise

typedef struct app_state app_state;
typedef struct lesson_state lesson_state;

enum { SENTENCE = 512, PASSES = 4 };

/// A subject: one file (lesson_search.c, lesson_subdivision.c, ...) and one row of the table in
/// lesson.c. Its record stands in lesson_state. Functions from `code` on may be NULL. All but the
/// first two are called only while there is a step: at < length.
typedef struct subject_row {
    const char *title;
    bool (*fits)(const document_state *document); ///< whether it has a place there; NULL: always
    bool of_eye; ///< recorded anew where the eye's cell is another; needs one
    /// Records all steps. lesson_forget() drops the record.
    sl_status (*record)(sl_context *context, lesson_state *lesson, const document_state *document,
                        uint32_t source);
    size_t (*length)(const lesson_state *lesson);
    void (*sentence)(const lesson_state *lesson, const document_state *document,
                     char text[SENTENCE]);
    /// The pseudo-code; *lit is the line of the step.
    const char *const *(*code)(const lesson_state *lesson, const document_state *document,
                               size_t *count, size_t *lit);
    /// What has been found so far, in a sentence.
    void (*account)(const lesson_state *lesson, char text[SENTENCE]);
    /// The portals of the step's sequence, into lesson->ends. The dual plane then shows its lines,
    /// and they can be dragged.
    uint32_t (*sequence)(const lesson_state *lesson, const sl_space *space, sl_portal_ends *ends);
    void (*below)(app_state *app, const sl_frame *frame); ///< drawn below the walls
    void (*above)(app_state *app, const sl_frame *frame); ///< and above them
} subject_row;

extern const subject_row lesson_search, lesson_subdivision, lesson_pass, lesson_effects;

/// All subjects.
const subject_row *const *subject_table(size_t *count);

/// What the bake says of a pair of cells.
typedef enum effect_fact {
    FACT_SEEN,    ///< past walls alone
    FACT_SEES,    ///< likewise, and not the other way
    FACT_DOORS,   ///< while some doors are open
    FACT_MIRROR,  ///< by mirror alone
    FACT_WATCHED, ///< not, but the other way
    FACT_DARK,    ///< not, for glass
    FACT_RANGE,   ///< not, for the range (or glass, where there is any)
    FACT_NONE,    ///< not, for walls
} effect_fact;

typedef struct effect_step {
    uint32_t cell;
    effect_fact fact;
    size_t entry; ///< of lesson->steps, where a search of walls alone enters it; 0 for none
} effect_step;

/// Zeroed to start.
struct lesson_state {
    size_t subject; ///< of the table
    bool made;
    uint32_t version, source; ///< what was recorded: of which document, from which cell
    sl_steps steps;           ///< of the search
    SL_ARRAY(effect_step) effects;
    size_t subdivision_steps;
    sli_mesh_steps mesh;     ///< of the subdivision, where it is a mesh
    sli_pass passes[PASSES]; ///< of multipass, by quadrant
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

const subject_row *lesson_subject(const lesson_state *lesson);
/// Goes to the next subject that the map allows; the next update records it.
void lesson_change(sl_context *context, lesson_state *lesson, const document_state *document);
/// Whether there is a step to show for the present document.
bool lesson_shows(const lesson_state *lesson, const document_state *document);

/// Records again where the document, the source or the subject changed.
sl_status lesson_update(sl_context *context, lesson_state *lesson, const document_state *document,
                        uint32_t source);
/// Drops the record.
void lesson_forget(sl_context *context, lesson_state *lesson);
void lesson_destroy(sl_context *context, lesson_state *lesson);

size_t lesson_length(const lesson_state *lesson);
/// Shows a step; the first or the last one beyond the ends.
void lesson_go(lesson_state *lesson, const document_state *document, size_t step);
/// Plays on.
void lesson_tick(lesson_state *lesson, const document_state *document, double seconds);

/// An end was dragged: computes the lines again.
void lesson_refresh(lesson_state *lesson);

void lesson_sentence(const lesson_state *lesson, const document_state *document,
                     char text[SENTENCE]);

#endif
