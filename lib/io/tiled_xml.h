/// Tiled's XML files (.tmx, .tsx) in the shape of its JSON files (.tmj, .tsj), so that one reader
/// reads both.
#ifndef SL_IMPORT_TILED_XML_H
#define SL_IMPORT_TILED_XML_H

#include "io/json.h"

/// Reads a document whose root element has this name ("map", "tileset"). Numbers stay text, a
/// polygon's points too; every object knows its line. SL_BAD_INPUT with the line where it is no
/// such document. sl_json_close is the caller's.
sl_status sl_tiled_from_xml(sl_context *context, const char *name, const char *root,
                            const char *text, size_t size, sl_json_file *file);

#endif
