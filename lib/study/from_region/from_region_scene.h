/// The scene of the from-region methods: view cells, faces, objects and passes; and the solvers.
#ifndef SL_FROM_REGION_SCENE_H
#define SL_FROM_REGION_SCENE_H

#include "cell_to_cell/search/sectors.h"
#include "sightline/from_region.h"
#include "sightline/space.h"
#include "sightline/support.h"

#define SL_NO_VIEW_CELL UINT32_MAX

enum { SLI_QUADRANTS = 4 };

/// Quadrant q goes counter-clockwise from axis q to the next one: +x, +y, -x, -y.
static inline bool sli_goes_right(int quadrant) {
    return quadrant == 0 || quadrant == 3;
}

static inline bool sli_goes_up(int quadrant) {
    return quadrant < 2;
}

/// A face: an open piece of a view cell's border, as a sightline crosses it on the way out.
typedef struct sli_face {
    uint32_t from, to; ///< view cells; `to` SL_NO_VIEW_CELL at the boundary of the compound
    uint32_t directed; ///< of the space
} sli_face;

/// A piece of an object within one leaf. A wall has a side of the leaf, as it is crossed outwards.
/// An object that is seen through has a box; each quadrant's lines cross a diagonal of the box.
typedef struct sli_item {
    uint32_t object, leaf;
    bool through;
    sl_point left, right; ///< the ends of a side; or the lower left and upper right box corner
} sli_item;

/// An item's ends as a quadrant's lines cross them.
static inline sl_portal_ends sli_item_ends(const sli_item *item, int quadrant) {
    if (!item->through) return (sl_portal_ends){item->left, item->right};
    const sl_point a = item->left, b = item->right;
    const sl_point ends[SLI_QUADRANTS + 1] = {{a.x, b.y}, a, {b.x, a.y}, b, {a.x, b.y}};
    return (sl_portal_ends){ends[quadrant], ends[(quadrant + 2) % SLI_QUADRANTS]};
}

/// A quadrant's pass: orders in which those behind come first.
typedef struct sli_from_region_pass {
    sli_pass leaves;
    uint32_t *place; ///< by leaf: its place in an order of all leaves, whatever walls are between
    sli_order view_cells;
} sli_from_region_pass;

struct sl_from_region_scene {
    sl_map map; ///< with seams along view cells' borders
    sl_space space;
    sl_from_region_counts counts;
    uint32_t *view_cell; ///< by leaf
    char **names;        ///< of view cells that have one; NULL for none
    SL_ARRAY(sli_face) faces;
    uint32_t *first_face; ///< by view cell, and one more: its faces
    uint32_t *face_of;    ///< by directed portal: UINT32_MAX for none
    SL_ARRAY(sli_item) items;
    uint32_t *first_item;                   ///< by object, and one more: its items
    uint32_t *leaf_items, *first_leaf_item; ///< by leaf, and one more: items of the leaf
    uint32_t occluders; ///< extra objects past the last, for walls that are no objects
    sl_box *boxes;      ///< by object: around its items
    sli_from_region_pass passes[SLI_QUADRANTS];
    sl_bits *inside; ///< by view cell: objects that lie in it
    size_t words;    ///< of a row of objects, occluders included
};

sl_box sli_leaf_box(const sl_space *space, uint32_t leaf);

/// The grid's line of a number, 0 to `grid`, across an axis.
double sli_grid_line(const sl_box *bounds, int axis, uint32_t line, uint32_t grid);

/// Finds the faces between view cells.
sl_status sli_from_region_find_faces(sl_context *context, sl_from_region_scene *scene);

/// Assigns leaves to view cells; finds the objects.
sl_status sli_from_region_find_view_cells(sl_context *context,
                                          const sl_from_region_scene_options *options,
                                          sl_from_region_scene *scene);
sl_status sli_from_region_find_objects(sl_context *context,
                                       const sl_from_region_scene_options *options,
                                       sl_from_region_scene *scene);

/// SL_BAD_INPUT, with the cycle named, where view cells depend on each other in a cycle in some
/// quadrant. Where the options say so it cuts one of them in two instead and sets *cut: the caller
/// then finds faces and orders anew.
sl_status sli_from_region_check_cycles(sl_context *context,
                                       const sl_from_region_scene_options *options,
                                       sl_from_region_scene *scene, bool *cut);

/// Objects, occluders included.
static inline uint32_t sli_from_region_objects(const sl_from_region_scene *scene) {
    return scene->counts.objects + scene->occluders;
}

static inline sl_bits *sli_from_region_inside(const sl_from_region_scene *scene,
                                              uint32_t view_cell) {
    return scene->inside + view_cell * scene->words;
}

// --- halving along the longer side

/// A view cell or a wall, by its number, at its middle.
typedef struct sli_placed {
    sl_point at;
    uint32_t number;
} sli_placed;

/// Sorts items along the longer side of the box about them: true for x. There must be one.
bool sli_placed_sort(sli_placed *items, size_t count, sl_box *box);

// --- solvers

/// A question to a solver: which objects of the refine set are seen through the face, within the
/// quadrant?
typedef struct sli_from_region_query {
    const sli_face *face;
    int quadrant;
    const sl_bits *refine;
} sli_from_region_query;

/// What a solver counts.
typedef struct sli_from_region_account {
    uint64_t images, rays, refined;
} sli_from_region_account;

typedef struct sli_from_region_solver_calls {
    sl_status (*create)(sl_context *context, const sl_from_region_scene *scene,
                        const sl_from_region_options *options, void **state);
    void (*destroy)(sl_context *context, void *state);
    /// Adds what is seen to `seen`.
    sl_status (*run)(sl_context *context, void *state, const sli_from_region_query *query,
                     sl_bits *seen, sli_from_region_account *account);
} sli_from_region_solver_calls;

const sli_from_region_solver_calls *sli_from_region_sampling(void);
const sli_from_region_solver_calls *sli_from_region_stabs(void);

#endif
