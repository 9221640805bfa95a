/// Registers the formats of sightline_io, and the commands that need them.
#include "commands/commands.h"
#include "system/built.h"

static const built_command commands[] = {{"reject", cmd_reject}, {0}};

static const built_io io = {
    .use = sl_io_use,
    .layers_dxf = sl_drawing_layers_dxf,
    .layers_svg = sl_drawing_layers_svg,
    .layers_destroy = sl_drawing_layers_destroy,
    .polylines_dxf = sl_polylines_write_dxf,
    .image_read = sl_image_read,
    .image_destroy = sl_image_destroy,
};

const built_part with_io = {.commands = commands, .io = &io};
