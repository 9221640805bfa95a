/// Objects that stand or move where the bake knows nothing of them: what one view makes of them.
#ifndef EYE_OBJECTS_H
#define EYE_OBJECTS_H

#include "eye_run.h"
#include "json_print.h"
#include "options.h"
#include "sightline/moving.h"

typedef struct sl_eye_object {
    const char *text; ///< as it was given
    uint32_t cells;   ///< that it lies in or touches
    bool possible;    ///< one of them is in the visible set of the eye's cell
    bool in_exact;    ///< one of them is seen, by exact culling without objects
} sl_eye_object;

/// Zeroed: none.
typedef struct sl_eye_objects {
    size_t count;
    sl_moving_box *boxes;
    sl_eye_object *objects;
    bool *seen;          ///< by object
    bool *mirrored;      ///< by object: whether it is seen by mirror
    uint64_t *cells;     ///< seen past those that block
    uint32_t cell_count; ///< of them
    double share;        ///< of the area, as in sl_eye_run
    sl_region region;    ///< past those that block
    double region_share;
    bool has_mirrors;         ///< the map; else the rest of this is empty
    uint64_t *mirrored_cells; ///< seen by mirror past those that block
    uint32_t mirrored_count;  ///< of them
    double mirrored_share;
    sl_mirrored_region mirrored_region;
    double seconds; ///< to put the boxes in; 0 where it was not timed
} sl_eye_objects;

/// Reads X0,Y0,X1,Y1 or the name of the map's object, each with ',block' behind it or not.
sl_status sl_eye_objects_read(sl_context *context, const sl_option_list *texts, const sl_map *map,
                              sl_eye_objects *out);
/// What the view makes of them.
sl_status sl_eye_objects_run(sl_context *context, const sl_baked *baked, const sl_eye_run *run,
                             bool timed, sl_eye_objects *objects);
void sl_eye_objects_print(const sl_eye_objects *objects);
/// "objects", "past_objects": nothing where there are none.
void sl_eye_objects_add_json(sl_json_fields *fields, const sl_baked *baked,
                             const sl_eye_objects *objects);
void sl_eye_objects_destroy(sl_context *context, sl_eye_objects *objects);

#endif
