/// The tiles of a Tiled layer, in all the ways that they are written.
#ifndef SL_IMPORT_TILED_DATA_H
#define SL_IMPORT_TILED_DATA_H

#include "io/json.h"

/// A tile's number in a layer has these bits for how it is turned; the rest is the tile.
#define SL_TILED_ACROSS   0x80000000u ///< mirrored left to right, after the next two
#define SL_TILED_DOWN     0x40000000u ///< mirrored top to bottom
#define SL_TILED_DIAGONAL 0x20000000u ///< x and y exchanged
#define SL_TILED_TILE     0x0fffffffu

/// Reads `count` numbers: an array, or text by the layer's "encoding" (csv, base64) and
/// "compression" (none, zlib, gzip, zstd). sl_free(*gids) is the caller's. SL_BAD_INPUT where there
/// are more or fewer, or the text is damaged.
sl_status sl_tiled_read_data(const sl_json *layer, const sl_json *data, size_t count,
                             uint32_t **gids);

#endif
