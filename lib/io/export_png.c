/// Export as a PNG with one bit per pixel. The pixel in row a and column b is black where cell a
/// sees cell b. Rows are written one at a time, so that the picture is never in memory as a whole.
///
/// A map with mirrors takes two bits per pixel: black is seen directly, dark grey directly and by
/// mirror, light grey by mirror alone, white not at all.
#include "io/io_formats.h"
#include "sightline/io.h"
#include "sightline/support.h"

#include <png.h>
#include <setjmp.h>
#include <string.h>

/// libpng's largest side, by default.
#define MOST_CELLS 1000000u

typedef struct picture {
    sl_context *context;
    const sl_pvs *pvs, *mirrored; ///< `mirrored` has no rows where there are no mirrors
    FILE *stream;
    uint8_t *row;
    size_t bytes;
} picture;

static void fill_row(const picture *p, uint32_t cell) {
    memset(p->row, 0xff, p->bytes);
    for (sl_pvs_run run = sl_pvs_begin(p->pvs, cell); sl_pvs_next(&run);)
        for (uint32_t i = run.first; i < run.end; i++) p->row[i / 8] &= (uint8_t) ~(0x80u >> i % 8);
}

/// A pixel is 3 where nothing is seen, 2 by mirror alone, 1 in both ways, 0 directly alone.
static void fill_row_of_two(const picture *p, uint32_t cell) {
    memset(p->row, 0xff, p->bytes);
    for (sl_pvs_run run = sl_pvs_begin(p->mirrored, cell); sl_pvs_next(&run);)
        for (uint32_t i = run.first; i < run.end; i++)
            p->row[i / 4] ^= (uint8_t)(0x40u >> 2 * (i % 4));
    for (sl_pvs_run run = sl_pvs_begin(p->pvs, cell); sl_pvs_next(&run);)
        for (uint32_t i = run.first; i < run.end; i++)
            p->row[i / 4] ^= (uint8_t)(0xc0u >> 2 * (i % 4));
}

/// libpng reports a lack of memory or of disk space by a jump to here.
static sl_status write_rows(const picture *p, png_structp png, png_infop info) {
    if (setjmp(png_jmpbuf(png))) return ferror(p->stream) ? SL_OK : sl_fail_memory(p->context);
    png_init_io(png, p->stream);
    const bool mirrors = p->mirrored->cell_count > 0;
    png_set_IHDR(png, info, p->pvs->cell_count, p->pvs->cell_count, mirrors ? 2 : 1,
                 PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    for (uint32_t cell = 0; cell < p->pvs->cell_count; cell++) {
        SL_TRY(sl_check_cancelled(p->context));
        mirrors ? fill_row_of_two(p, cell) : fill_row(p, cell);
        png_write_row(png, p->row);
        sl_report(p->context, "export", "cells", cell + 1, p->pvs->cell_count);
    }
    png_write_end(png, info);
    return SL_OK;
}

static void pass_over(png_structp png, png_const_charp message) {
    (void)png;
    (void)message;
}

static void jump(png_structp png, png_const_charp message) {
    (void)message;
    png_longjmp(png, 1);
}

static sl_status write_picture(const picture *p) {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, jump, pass_over);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    const sl_status status = info ? write_rows(p, png, info) : sl_fail_memory(p->context);
    png_destroy_write_struct(&png, &info);
    return status;
}

sl_status sli_export_png(sl_context *context, const sl_baked *baked,
                         const sl_export_options *options, const char *path) {
    (void)options;
    picture p = {
        .context = context, .pvs = &baked->visibility.pvs, .mirrored = &baked->visibility.mirrored};
    if (p.pvs->cell_count == 0 || p.pvs->cell_count > MOST_CELLS)
        return sl_fail(context, SL_UNSUPPORTED, "a picture of %u x %u pixels cannot be written",
                       p.pvs->cell_count, p.pvs->cell_count);
    const unsigned bits = p.mirrored->cell_count ? 2 : 1;
    p.bytes = ((size_t)p.pvs->cell_count * bits + 7) / 8;
    p.row = sl_alloc_array(context, p.bytes, 1);
    if (!p.row) return SL_NO_MEMORY;
    sl_output output;
    sl_status status = sl_output_open(context, path, &output);
    if (status == SL_OK) {
        p.stream = output.stream;
        status = sl_output_close(context, &output, write_picture(&p));
    }
    sl_free(context, p.row);
    return status;
}
