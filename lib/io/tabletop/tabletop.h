/// What the readers of virtual tabletops share: names of doors, marks of files of our own, layers,
/// and the edge of a scene.
#ifndef SL_TABLETOP_H
#define SL_TABLETOP_H

#include "io/parts/document.h"
#include "io/parts/things.h"

// --- doors

/// The naming of doors. Zeroed, it begins.
typedef struct sli_door_names {
    const sli_json *doors; ///< the list that they are from
    bool flags;            ///< names of files of our own stand in "flags"
    bool checks;           ///< some doors have such names
    size_t number;
} sli_door_names;

sli_door_names sli_door_names_of(const sli_json *doors, bool flags);
/// A door's own name, else "door" and a number: the next one that no door in the list has.
const char *sli_name_of_door(sli_door_names *names, const sli_json *door, char made[32]);

// --- files of our own

/// What a file of our own says of the whole map, in `own`: the y that is 0, the view range, the sum
/// of its digits (NULL for none).
sl_status sli_tabletop_own(const sli_json *own, double *top, const char **mark, sl_map *map);

// --- the edge of a scene

/// The edge of a scene: eyes and steps end there. It is taken as walls where the map's walls leave
/// it open (edge.c). Set all but the last three; zero these.
typedef struct sli_edge {
    sl_context *context;
    const char *file;
    sl_box box;      ///< the scene, in the map's places; empty: not known
    bool asked;      ///< all of it is taken, whatever the walls are
    const char *off; ///< the value of --layers that leaves it out, and the one that takes all
    const char *all;
    SL_ARRAY(sl_segment) pieces; ///< what is found
    bool whole;                  ///< they are all of the edge
    bool started;                ///< starts say what is ground
    double closed_off;           ///< the share of the scene that nothing leads to
} sli_edge;

/// How many ends of walls are in the box, of all kinds of walls.
size_t sli_edge_holds(const sl_map *map, sl_box box, size_t *all);

/// Finds the pieces of the edge that become walls. Starts that reach little are marked
/// (sli_thing.doubt), and do not count.
sl_status sli_edge_find(sli_edge *edge, const sl_map *map, sli_things *things);
/// Adds them as walls with this number, and says so.
sl_status sli_edge_add(const sli_edge *edge, sl_map *map, uint32_t item);
void sli_edge_destroy(sli_edge *edge);

#endif
