/// same_picture A.png B.png: prints the share of pixels that differ, a pixel differing where a
/// channel does by more than 24 of 255. Fonts are drawn a little otherwise from machine to machine;
/// a layer that is missing differs by more. Directed portals 2 where the pictures are not of one
/// size.
#include <png.h>
#include <stdio.h>
#include <stdlib.h>

enum { CHANNELS = 3, LEVELS = 24 };

static png_bytep read_picture(const char *path, png_image *image) {
    *image = (png_image){.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_file(image, path)) return NULL;
    image->format = PNG_FORMAT_RGB;
    png_bytep pixels = malloc(PNG_IMAGE_SIZE(*image));
    if (pixels && png_image_finish_read(image, NULL, pixels, 0, NULL)) return pixels;
    free(pixels);
    return NULL;
}

static double differing(const png_byte *a, const png_byte *b, size_t count) {
    size_t differ = 0;
    for (size_t i = 0; i < count; i++) {
        int most = 0;
        for (size_t k = 0; k < CHANNELS; k++) {
            const int by = abs(a[CHANNELS * i + k] - b[CHANNELS * i + k]);
            if (by > most) most = by;
        }
        differ += most > LEVELS;
    }
    return (double)differ / (double)count;
}

int main(int argc, char **argv) {
    png_image a, b;
    if (argc != 3) return 2;
    png_bytep first = read_picture(argv[1], &a), second = read_picture(argv[2], &b);
    int status = 2;
    if (!first || !second)
        fprintf(stderr, "same_picture: cannot read %s\n", first ? argv[2] : argv[1]);
    else if (a.width != b.width || a.height != b.height)
        fprintf(stderr, "same_picture: %ux%u against %ux%u\n", a.width, a.height, b.width,
                b.height);
    else {
        printf("%.6f\n", differing(first, second, (size_t)a.width * a.height));
        status = 0;
    }
    free(first);
    free(second);
    return status;
}
