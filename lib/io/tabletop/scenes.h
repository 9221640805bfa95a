/// The scenes in a file of Foundry: one, an adventure, an exported list, or a database of one
/// document a line.
#ifndef SL_SCENES_H
#define SL_SCENES_H

#include "io/parts/document.h"
#include "sightline/import.h"

/// A scene that has walls, by a name that no other has.
typedef struct sli_scene {
    json_t *json; ///< of the file
    char *name;
} sli_scene;

/// Zeroed, there are none.
typedef struct sli_scenes {
    sl_context *context;
    sli_json_file file;
    SL_ARRAY(sli_scene) items;
    json_t *names;  ///< those taken
    size_t without; ///< scenes that have no walls
    size_t bad;     ///< lines of a database that are no documents
    unsigned first_bad;
} sli_scenes;

/// Reads a file. A list of walls alone, or a scene that is the whole file, is its one scene.
/// SL_BAD_INPUT, with what to do, for a database that is no text.
sl_status sli_scenes_open(sl_context *context, const char *name, const char *text, size_t size,
                          sli_scenes *scenes);
/// Notes what is left out.
void sli_scenes_tell(const sli_scenes *scenes);
void sli_scenes_close(sli_scenes *scenes);

#endif
