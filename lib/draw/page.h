/// The page of a picture in a file. It is measured first, since the size of a file must be known
/// before anything is drawn. Then it is drawn by the same functions.
#ifndef SL_DRAW_PAGE_H
#define SL_DRAW_PAGE_H

#include "draw/draw_plan.h"
#include "draw/live.h"
#include "sightline/support.h"

// --- files

typedef struct sli_paper_kind sli_paper_kind;

/// The kind of file, by the ending of its name; SL_BAD_ARGUMENT for an unknown ending.
sl_status sli_paper_kind_of(sl_context *context, const char *path, const sli_paper_kind **out);

typedef struct sli_paper {
    const sli_paper_kind *kind;
    const char *path; ///< the caller's
    cairo_surface_t *surface;
    cairo_t *cairo; ///< to draw with
    sl_output output;
    sl_context *context;
    bool to_scale;        ///< lengths are points, and layers and texts are kept (live.h)
    sli_text_buffer text; ///< what is kept back until the end (SVG, sheets)
    bool out_of_memory;   ///< while that was being kept
    bool stopped;         ///< the context's hook said so while the file was written
} sli_paper;

/// A blank page. `title` (NULL for none) goes into the file's description if the kind has one.
/// `to_scale` as in sli_paper.
sl_status sli_paper_open(sl_context *context, const sli_paper_kind *kind, const char *path,
                         double width, double height, bool to_scale, const char *title,
                         sli_paper *out);

/// Writes the file if `status` is SL_OK and cairo did not fail; else leaves nothing.
sl_status sli_paper_close(sl_context *context, sli_paper *paper, sl_status status);

// --- pages

/// Lengths in pixels (PDF: points).
typedef struct sli_page {
    double width, height;
    double margin; ///< left, right and above
    double inner;  ///< the width between the margins
    double text; ///< size of the text, which shrinks less than a page does: small ones are readable
    double plan_scale; ///< of the frame; 0: the plan is as large as it can be
    sl_frame frame;    ///< of the plan
    double bottom;     ///< of the place of the plan, which may be lower than its frame
    double key;        ///< the top of what stands below the plan
} sli_page;

/// SL_BAD_ARGUMENT for a width that no page can have.
sl_status sli_page_check_width(sl_context *context, double width);

/// A page of that width, rounded, with nothing on it yet.
sli_page sli_page_of_width(double width);

/// Places the plan from `top` on. It is as wide as the margins allow, and as high as `bounds` then
/// are, but between a sixth and `tallest` of its width. So a long thin map is not stretched, and a
/// page stays within the 32,767 pixels of cairo.
void sli_page_place_plan(sli_page *page, sl_box bounds, double top, double tallest);

/// The usual `tallest`.
#define SLI_PAGE_TALLEST 1.4

/// A title and a fainter line below it, from the margin down; NULL for none. Returns where they
/// end. Draws only with `paint`.
double sli_page_heading(cairo_t *cairo, const sli_page *page, const sl_palette *palette,
                        const char *title, const char *subtitle, bool paint);

/// Runs a layout that measures text, on a surface that is then thrown away. Failures of cairo name
/// `path`.
sl_status sli_page_measure(sl_context *context, const char *path,
                           sl_status (*lay_out)(sl_context *context, cairo_t *cairo, void *what),
                           void *what);

/// The parts and labels of a scene's options over its plan; `text` is the size of the page's.
sl_status sli_draw_over_plan(sl_context *context, cairo_t *cairo, const sl_scene *scene,
                             const sl_frame *frame, double text);
/// The key of these parts, and the words of the options, from `y` on. Returns their height. Draws
/// only with `paint`.
double sli_draw_over_key(cairo_t *cairo, const sl_scene *scene, const sli_page *page, double y,
                         bool paint);

/// The contents of a page. `what` belongs to the picture.
typedef struct sli_page_parts {
    /// Without `paint`: measures, places the plan and sets the height. Else draws all but the plan,
    /// in the same places.
    void (*set)(cairo_t *cairo, const void *what, sli_page *page, bool paint);
    /// Draws the plan, before the rest.
    sl_status (*draw_plan)(sl_context *context, cairo_t *cairo, const void *what,
                           const sl_frame *frame);
    const void *what;
    const sl_scene *scene; ///< whose options may ask for a sheet of paper; NULL: none does
    sl_colour ground;
    const char *title; ///< in the file's description and the title block, NULL for none
} sli_page_parts;

/// Sets the parts, and what the options of their scene add below them.
void sli_page_set(cairo_t *cairo, const sli_page_parts *parts, sli_page *page, bool paint);

/// Measures, draws and writes a page of that width.
sl_status sli_page_write(sl_context *context, const sli_page_parts *parts, double width,
                         const sli_paper_kind *kind, const char *path);

/// Where a page about a map goes: into a file, or onto another page.
typedef struct sli_page_target {
    const char *path; ///< of the file; NULL: onto the page of `cairo`
    cairo_t *cairo;
    sl_point at;   ///< of its upper left corner on that page
    bool paint;    ///< false only measures
    double height; ///< set to that of the page
} sli_page_target;

/// Draws a page about the walls of a map, `layers` of it. `scene` is the picture's own, and is made
/// and cleared here; the ground and the title of `parts` come from it and from the options.
sl_status sli_page_draw_map(sl_context *context, const sl_baked *baked,
                            const sl_draw_options *options, unsigned layers, sl_scene *scene,
                            sli_page_parts parts, sli_page_target *target);

/// sl_draw_field_file and sl_draw_lines_file, or the plan with its starts where both are NULL.
sl_status sli_draw_picture(sl_context *context, const sl_baked *baked, const sl_field *field,
                           const sl_drawn_lines *lines, const sl_draw_options *options,
                           sli_page_target *target);

/// sl_draw_coverage_file
sl_status sli_draw_coverage(sl_context *context, const sl_baked *baked,
                            const sl_drawn_coverage *coverage, const char *caption,
                            const sl_draw_options *options, sli_page_target *target);

/// A key whose entries stand in lines as the width allows.
typedef struct sli_key {
    double left, width, size;
    sl_point at; ///< the upper left corner of the next entry
} sli_key;

sli_key sli_key_at(sl_point at, double width, double size);
/// Adds an entry and returns its upper left corner: a swatch of two sizes' width has room there,
/// before the text. Draws only with `paint`.
sl_point sli_key_entry(cairo_t *cairo, sl_colour ink, sli_key *key, const char *text, bool paint);
/// Where the lines end, below `at`.
double sli_key_end(const sli_key *key);

/// A text below a picture, in lines as the width allows. Returns the height; 0 for NULL. Draws only
/// with `paint`.
double sli_page_caption(cairo_t *cairo, const sli_page *page, const sl_palette *palette, double y,
                        const char *caption, bool paint);

/// The key of the colours of sli_draw_seen, from a place on the page, in lines as the width allows.
/// Returns the height; 0 if nothing is seen by mirror. Draws only with `paint`.
double sli_draw_seen_key(cairo_t *cairo, const sl_palette *palette, const sl_drawn_region *regions,
                         size_t count, sl_point at, double width, double size, bool paint);

/// The key of solid ground and of what is outside, in one line, likewise. Returns 0 for maps where
/// nothing is solid and nothing outside is shown.
double sli_draw_ground_key(cairo_t *cairo, const sl_scene *scene, sl_point at, double size,
                           bool paint);

#endif
