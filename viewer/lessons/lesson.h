/// The lesson shows a search, a subdivision or the passes of multipass step by step. Each step is a
/// sentence with a line of pseudo-code. The lines through the portal sequence of the step can be
/// dragged.
#ifndef VIEWER_LESSON_H
#define VIEWER_LESSON_H

#include "cell_to_cell/search/sectors.h" // private: lessons show the inside of the library
#include "document/document.h"
#include "sightline/art_gallery.h"
#include "sightline/draw.h"
#include "sightline/dual.h"
#include "sightline/explain.h"
#include "sightline/glpk.h"
#include "sightline/place.h"
#include "sightline/steps.h"
#include "sightline/support.h"
#include "space/mesh.h" // private, likewise

typedef struct learn_state learn_state;
typedef struct lesson_state lesson_state;

enum { SENTENCE = 512, PASSES = 4, UNDO_MOST = 64 };

/// A subject: one file (lesson_search.c, lesson_subdivision.c, ...) and one row of the table in
/// lesson.c. Its record stands in lesson_state. Functions from `code` on may be NULL. All but the
/// first two are called only while there is a step: at < length.
typedef struct subject_row {
    const char *title;
    bool (*fits)(const document_state *document); ///< whether it has a place there; NULL: always
    bool of_eye; ///< recorded anew where the eye's cell is another; needs one
    /// Records all steps.
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
    /// The cell that a step is about; SL_NO_CELL for none.
    uint32_t (*cell)(const lesson_state *lesson, size_t step);
    /// Whether a step finds something new, or rejects something; and what that is called.
    bool (*finds)(const lesson_state *lesson, size_t step);
    bool (*rejects)(const lesson_state *lesson, size_t step);
    const char *found, *rejected;
    void (*below)(learn_state *learn, const sl_frame *frame); ///< drawn below the walls
    void (*above)(learn_state *learn, const sl_frame *frame); ///< and above them
} subject_row;

extern const subject_row lesson_search, lesson_subdivision, lesson_pass, lesson_effects,
    lesson_place, lesson_fisk;

/// All subjects.
const subject_row *const *subject_table(size_t *count);
/// The place of one of them in the table.
size_t subject_find(const subject_row *subject);

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

/// What keys or the pointer can choose: a portal end (twice its portal's number, plus one for a
/// right end), the line, or nothing.
#define CHOSEN_NONE UINT32_MAX
#define CHOSEN_LINE (UINT32_MAX - 1)

/// The bounds that a search for the fewest cameras reported.
typedef struct lesson_bounds {
    uint64_t lower, upper;
} lesson_bounds;

/// A change by hand, as it was before.
typedef struct lesson_change {
    uint32_t what; ///< an end, or CHOSEN_LINE
    sl_portal_ends ends;
    sl_dual_line line;
} lesson_change;

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
    sl_shape outline; ///< these two: of Fisk's colouring
    sl_fisk fisk;
    sl_placement placement; ///< these three: of the fewest cameras
    SL_ARRAY(lesson_bounds) bounds;
    bool hurried;           ///< the search was stopped
    char refused[SENTENCE]; ///< why a subject does not fit the map; "": it does
    bool finds, rejects;    ///< some step does
    size_t at;              ///< the step shown
    bool plays;
    int speed; ///< powers of two: 0 is two steps a second
    double waited;
    /// The portals of the sequence at hand; their ends may have been dragged.
    sl_portal_ends ends[SL_DUAL_PORTALS_MOST];
    uint32_t end_count;
    bool dragged;                     ///< ends are not where the map has them
    sl_dual dual, before;             ///< with all portals, and without the last
    sl_dual_line line;                ///< the one chosen
    lesson_change changes[UNDO_MOST]; ///< for undo, the last one last
    size_t change_count;
    bool changes_dropped; ///< the oldest ones: they cannot be undone
    uint32_t chosen_next; ///< chosen by keys, as CHOSEN_... but from 1; 0: nothing
    uint32_t hovered;     ///< an end under the pointer, likewise
    size_t hovered_step;  ///< under the pointer on the time line, from 1; 0: none
    /// Worked out when asked for (lesson_conflict, lesson_program).
    bool conflict_known, program_known;
    sl_conflict conflict;
    sl_program program;
};

const subject_row *lesson_subject(const lesson_state *lesson);
/// Whether the map allows a subject.
bool lesson_fits(size_t subject, const document_state *document);
/// Goes to a subject, or to the next that the map allows; the next update records it.
void lesson_set_subject(sl_context *context, lesson_state *lesson, size_t subject);
void lesson_next_subject(sl_context *context, lesson_state *lesson, const document_state *document);
/// Whether there is a step to show for the present document.
bool lesson_shows(const lesson_state *lesson, const document_state *document);

/// Records again where the document, the source or the subject changed.
sl_status lesson_update(sl_context *context, lesson_state *lesson, const document_state *document,
                        uint32_t source);
void lesson_destroy(sl_context *context, lesson_state *lesson);

size_t lesson_length(const lesson_state *lesson);
/// Shows a step; the first or the last one beyond the ends.
void lesson_go(lesson_state *lesson, const document_state *document, size_t step);
/// Shows the next step that finds something, or with `rejects` the next that rejects something;
/// with `back` the one before. False where there is none.
bool lesson_seek(lesson_state *lesson, const document_state *document, bool rejects, bool back);
/// Slower or faster, by factors of two.
enum { SPEED_LEAST = -2, SPEED_MOST = 5 };
void lesson_set_speed(lesson_state *lesson, int speed);
/// Plays on.
void lesson_tick(lesson_state *lesson, const document_state *document, double seconds);

// --- the portal ends and the line, changed by hand

/// Keeps what is to be changed, for undo: an end or CHOSEN_LINE.
void lesson_keep(lesson_state *lesson, uint32_t what);
/// Takes the last change back; false where there is none.
bool lesson_undo(lesson_state *lesson);
/// Takes all changes back.
void lesson_reset(lesson_state *lesson, const document_state *document);
/// Moves an end to a place of the map. It never meets the other end of its portal.
void lesson_move_end(lesson_state *lesson, uint32_t end, sl_point to);
/// Moves the line, within the dual plane's frame.
void lesson_move_line(lesson_state *lesson, sl_dual_line to);

/// Chooses the next (or last) of: nothing, the line, each end.
void lesson_choose(lesson_state *lesson, bool back);
/// What is chosen: an end, CHOSEN_LINE or CHOSEN_NONE.
uint32_t lesson_chosen(const lesson_state *lesson);
/// The end to be marked: the one under the pointer, else the one chosen. False for none.
bool lesson_marked(const lesson_state *lesson, sl_stab_end *end);
/// "left end of portal 3".
void lesson_name_end(uint32_t end, char text[48]);

/// What keeps lines from the portals as they are now; exact.
const sl_conflict *lesson_conflict(sl_context *context, lesson_state *lesson, sl_status *status);
/// Their linear program; NULL with a status where there is none.
const sl_program *lesson_program(sl_context *context, lesson_state *lesson, sl_status *status);

void lesson_sentence(const lesson_state *lesson, const document_state *document,
                     char text[SENTENCE]);

#endif
