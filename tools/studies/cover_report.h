/// What given viewpoints see together, as text, JSON and a picture. `cover` and `place` share it.
#ifndef COVER_REPORT_H
#define COVER_REPORT_H

#include "reports/json_print.h"
#include "sightline/bake.h"
#include "sightline/coverage.h"
#include "sightline/draw.h"

typedef struct cover_report {
    const char *input; ///< the map's file
    const char *map;   ///< the name of one of several maps in it; NULL for none
    const sl_baked *baked;
    const sl_cameras *cameras;
    const sl_coverage *coverage;
    const char *needs; ///< what a placement may need a viewpoint for that sees no area alone; NULL
                       ///< for viewpoints that are given: such a one is spare
} cover_report;

enum { AREA_TEXT = 64 };

/// The viewpoints of cameras. The caller frees them (sl_free).
sl_status cover_viewpoints(sl_context *context, const sl_cameras *cameras, sl_viewpoint **out);

/// "not seen", "seen by 1" ...
extern const char *const cover_classes[SL_COVERAGE_CLASSES];

/// "52 m²", with four digits.
const char *cover_area_text(const cover_report *report, double area, char text[AREA_TEXT]);

/// "3 viewpoints see 52 m² of 60 m² inside (87 %)"; where all are signs: "3 signs can be read from
/// 52 m² of 60 m² inside (87 %)"
void cover_sentence(const cover_report *report, char *text, size_t size);

/// The sentence, classes, a line a viewpoint, spare ones, and the largest blind spots.
void cover_print(const cover_report *report);

/// "areas", "viewpoints" and "blind_spots".
void cover_add_json(json_fields *fields, const cover_report *report);

/// SL_BAD_INPUT with its line for a viewpoint outside the map or in solid ground; notes those that
/// are not inside, which see nothing that counts, or only through windows. `table`: their file.
sl_status cover_check_places(sl_context *context, const char *table, const sl_space *space,
                             const sl_cameras *cameras);

/// Notes rows with a heading and no field of view: these were to look one way. `remedy`: what gives
/// them one, as "a column fov".
void cover_note_headings(sl_context *context, const char *table, const sl_cameras *cameras,
                         const char *remedy);
/// Notes who sees nothing: a sign hangs on what it faces, and a camera on a wall stands at one side
/// of it.
void cover_note_blind(sl_context *context, const char *table, const cover_report *report);

/// So many blind spots are printed, and numbered in pictures.
enum { COVER_BLIND_MOST = 10 };

/// What a picture has of a report, which it refers to.
typedef struct cover_drawn {
    sl_drawn_coverage drawn;
    sl_viewpoint *viewpoints;
    const char **names;
    sl_point blind[COVER_BLIND_MOST];
} cover_drawn;

/// `out` must stay where it is.
sl_status cover_drawn_make(sl_context *context, const cover_report *report, cover_drawn *out);
void cover_drawn_destroy(sl_context *context, cover_drawn *drawn);

struct cover_path;

/// Draws classes and viewpoints, and what of a way they do not see; NULL for none. `caption` as
/// sl_draw_coverage_file().
sl_status cover_draw(sl_context *context, const cover_report *report, const struct cover_path *way,
                     const char *caption, const sl_draw_options *drawing, const char *path);

#endif
