/// What a build may leave out: the libraries SIGHTLINE_IO, SIGHTLINE_STUDY, SIGHTLINE_GLPK and
/// SIGHTLINE_DRAW. What commands use of each that is linked stands in commands/with_NAME.c.
/// Commands look it up here, and refuse by name what is not there.
#ifndef BUILT_H
#define BUILT_H

#include "sightline/draw.h"
#include "sightline/io.h"
#include "sightline/set_cover.h"
#include "system/console.h"

/// Commands that need the part.
typedef struct built_command {
    const char *name;
    sl_status (*run)(command_console *console, int argc, char **argv);
} built_command;

/// Functions of sightline/io.h.
typedef struct built_io {
    sl_status (*use)(sl_context *context);
    sl_status (*layers_dxf)(sl_context *context, const char *name, const char *text, size_t size,
                            sl_drawing_layers *out);
    sl_status (*layers_svg)(sl_context *context, const char *name, const char *text, size_t size,
                            sl_drawing_layers *out);
    void (*layers_destroy)(sl_context *context, sl_drawing_layers *layers);
    sl_status (*polylines_dxf)(sl_context *context, const sl_polyline *lines, size_t count,
                               const char *unit, const char *path);
    sl_status (*image_read)(sl_context *context, const char *name, const char *bytes, size_t size,
                            sl_image *out);
    void (*image_destroy)(sl_context *context, sl_image *image);
} built_io;

/// Functions of sightline/draw.h.
typedef struct built_draw {
    sl_draw_options (*options_default)(void);
    sl_status (*file)(sl_context *context, const sl_baked *baked, const sl_draw_options *options,
                      const char *path);
    sl_status (*check_sheet)(sl_context *context, const sl_baked *baked,
                             const sl_draw_options *options, const char *path);
    sl_status (*explanation)(sl_context *context, const sl_baked *baked,
                             const sl_explanation *explanation, const sl_draw_options *options,
                             const char *path);
    sl_status (*eye)(sl_context *context, const sl_baked *baked, const sl_view *view,
                     const sl_eye_layer *layers, size_t layer_count, const sl_drawn_region *parts,
                     size_t part_count, const sl_draw_options *options, const char *path);
    sl_status (*regions)(sl_context *context, const sl_baked *baked, const sl_drawn_region *regions,
                         size_t count, const char *caption, const sl_draw_options *options,
                         const char *path);
    sl_status (*set)(sl_context *context, const sl_baked *baked, const sl_drawn_set *set,
                     const char *caption, const sl_draw_options *options, const char *path);
    sl_status (*coverage)(sl_context *context, const sl_baked *baked,
                          const sl_drawn_coverage *coverage, const char *caption,
                          const sl_draw_options *options, const char *path);
    sl_status (*field)(sl_context *context, const sl_baked *baked, const sl_field *field,
                       const sl_draw_options *options, const char *path);
    sl_status (*patches)(sl_context *context, const sl_baked *baked, const sl_patches *patches,
                         const char *caption, const sl_draw_options *options, const char *path);
    sl_status (*lines)(sl_context *context, const sl_baked *baked, const sl_drawn_lines *lines,
                       const sl_draw_options *options, const char *path);
    sl_status (*chart)(sl_context *context, const sl_chart *chart, const char *path);
    sl_status (*document)(sl_context *context, const sl_document_block *blocks, size_t count,
                          const char *title, const char *path);
} built_draw;

/// A part that is linked. What it has not is NULL.
typedef struct built_part {
    const built_command *commands;            ///< the last has no name
    const sl_solver *(*const *solvers)(void); ///< the last is NULL
    const sl_cover_program *(*cover)(void);   ///< linear programs of set cover
    const built_io *io;
    const built_draw *draw;
} built_part;

extern const built_part with_io, with_study, with_glpk, with_draw;

/// Says which parts are linked, the last NULL, before anything else is asked. They are kept.
void built_register(const built_part *const *linked);

/// Runs a command of a part, by its name, argv[0]. SL_UNSUPPORTED where the part is off.
sl_status built_run(command_console *console, int argc, char **argv);

/// The solver of a number, from 0, which is the default; NULL past the last. Where the part is off,
/// it refuses.
const sl_solver *built_solver(size_t index);

/// What solves the linear programs of set cover; NULL where the part is off.
const sl_cover_program *built_cover_program(void);

/// Adds foreign formats to those that the context reads and writes, or formats that refuse.
sl_status built_use_formats(sl_context *context);
/// SL_UNSUPPORTED, naming the file, where the build has no foreign formats.
sl_status built_need_io(sl_context *context, const char *name, const built_io **out);

/// SL_UNSUPPORTED where the build has no pictures. Each command asks before it works for one.
sl_status built_need_pictures(sl_context *context);
/// How pictures are drawn; NULL where the build has none.
const built_draw *built_pictures(void);
/// sl_draw_options_default(); where the build has no pictures, nothing but a width.
sl_draw_options built_draw_options(void);

#endif
