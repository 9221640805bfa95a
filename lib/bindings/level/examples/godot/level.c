/// A class of Godot 3 over the level library: GDNative's calls become those of sl_level_*.
/* Baked levels in Godot 3: the class SightlineLevel for GDScript, by GDNative.
 *
 *     cc -shared -fPIC level.c -I GODOT-HEADERS -I ../.. -L DIR -lsightline_level -o liblevel.so
 *
 * GODOT-HEADERS is the repository godot-headers, branch 3.2 or newer of 3. level.gdnlib and
 * level.gdns name the library and the class; seen.gd uses it. Godot's vectors are floats of 32
 * bits: the level answers in doubles, and points are rounded on the way out. */
#include <gdnative_api_struct.gen.h>
#include <stdio.h>

#include "sightline_level.h"

static const godot_gdnative_core_api_struct *api;
static const godot_gdnative_ext_nativescript_api_struct *scripts;

typedef struct instance {
    sl_level *level;
} instance;

static void *create(godot_object *object, void *data) {
    (void)object;
    (void)data;
    instance *own = api->godot_alloc(sizeof *own);
    own->level = NULL;
    return own;
}

static void destroy(godot_object *object, void *data, void *user) {
    (void)object;
    (void)data;
    sl_level_close(((instance *)user)->level);
    api->godot_free(user);
}

/* What a method is called with. */
#define METHOD(name)                                                                               \
    static godot_variant name(godot_object *object, void *data, void *user, int count,             \
                              godot_variant **arguments)

/* Each method asks for its number of arguments, and all but open() for a level. */
static instance *begin(void *user, int count, int wanted, bool needs_level) {
    instance *own = user;
    if (count == wanted && (own->level || !needs_level)) return own;
    api->godot_print_error(count == wanted ? "no level is open" : "wrong number of arguments",
                           "SightlineLevel", __FILE__, __LINE__);
    return NULL;
}

static double number(godot_variant **arguments, int i) {
    return api->godot_variant_as_real(arguments[i]);
}

static godot_variant of_bool(int value) {
    godot_variant out;
    api->godot_variant_new_bool(&out, value != 0);
    return out;
}

static godot_variant of_int(int64_t value) {
    godot_variant out;
    api->godot_variant_new_int(&out, value);
    return out;
}

static godot_variant nothing(void) {
    godot_variant out;
    api->godot_variant_new_nil(&out);
    return out;
}

/* Calls `use` with an argument as UTF-8. */
static int with_text(godot_variant *argument, int (*use)(instance *, const char *, int),
                     instance *own, int value) {
    godot_string string = api->godot_variant_as_string(argument);
    godot_char_string utf8 = api->godot_string_utf8(&string);
    const int result = use(own, api->godot_char_string_get_data(&utf8), value);
    api->godot_char_string_destroy(&utf8);
    api->godot_string_destroy(&string);
    return result;
}

static int open_file(instance *own, const char *name, int value) {
    (void)value;
    sl_level *level = sl_level_open_file(name);
    if (!level) {
        api->godot_print_error(sl_level_error(), "SightlineLevel.open", __FILE__, __LINE__);
        return 0;
    }
    sl_level_close(own->level);
    own->level = level;
    sl_level_use_file_coordinates(level); /* y is down in Godot: so it is in most maps' files */
    return 1;
}

static int set_doors(instance *own, const char *name, int open) {
    int found = 0;
    int32_t door = sl_level_find_door(own->level, name, 0);
    for (; door >= 0; door = sl_level_find_door(own->level, name, door + 1), found = 1)
        sl_level_set_door(own->level, door, open);
    return found;
}

/* open(path): false, with a message, if it is no level. The path is one of the system. */
METHOD(method_open) {
    (void)object, (void)data;
    instance *own = begin(user, count, 1, false);
    return own ? of_bool(with_text(arguments[0], open_file, own, 0)) : nothing();
}

/* set_door(name, open): false for no such door. */
METHOD(method_set_door) {
    (void)object, (void)data;
    instance *own = begin(user, count, 2, true);
    return own ? of_bool(with_text(arguments[0], set_doors, own,
                                   api->godot_variant_as_bool(arguments[1])))
               : nothing();
}

METHOD(method_cell_count) {
    (void)object, (void)data, (void)arguments;
    instance *own = begin(user, count, 0, true);
    return own ? of_int(sl_level_cell_count(own->level)) : nothing();
}

/* locate(x, y): -1 for no cell. */
METHOD(method_locate) {
    (void)object, (void)data;
    instance *own = begin(user, count, 2, true);
    return own ? of_int(sl_level_locate(own->level, number(arguments, 0), number(arguments, 1)))
               : nothing();
}

METHOD(method_can_see) {
    (void)object, (void)data;
    instance *own = begin(user, count, 2, true);
    if (!own) return nothing();
    return of_bool(
        sl_level_can_see(own->level, (int32_t)number(arguments, 0), (int32_t)number(arguments, 1)));
}

METHOD(method_sees) {
    (void)object, (void)data;
    instance *own = begin(user, count, 4, true);
    if (!own) return nothing();
    return of_bool(sl_level_sees(own->level, number(arguments, 0), number(arguments, 1),
                                 number(arguments, 2), number(arguments, 3)));
}

/* look(x, y, range): a PoolIntArray of cells. */
METHOD(method_look) {
    (void)object, (void)data;
    instance *own = begin(user, count, 3, true);
    if (!own) return nothing();
    int32_t found;
    const int32_t *cells = sl_level_look(own->level, number(arguments, 0), number(arguments, 1), 0,
                                         360, number(arguments, 2), &found);
    godot_pool_int_array list;
    godot_variant out;
    api->godot_pool_int_array_new(&list);
    for (int32_t i = 0; i < found; i++) api->godot_pool_int_array_append(&list, cells[i]);
    api->godot_variant_new_pool_int_array(&out, &list);
    api->godot_pool_int_array_destroy(&list);
    return out;
}

/* A PoolVector2Array, for Polygon2D or draw_colored_polygon(). */
static godot_variant of_points(const double *points, int32_t found) {
    godot_pool_vector2_array list;
    godot_variant out;
    api->godot_pool_vector2_array_new(&list);
    for (int32_t i = 0; i < found; i++) {
        godot_vector2 point;
        api->godot_vector2_new(&point, (float)points[2 * i], (float)points[2 * i + 1]);
        api->godot_pool_vector2_array_append(&list, &point);
    }
    api->godot_variant_new_pool_vector2_array(&out, &list);
    api->godot_pool_vector2_array_destroy(&list);
    return out;
}

/* bounds(): the least and the greatest corner. */
METHOD(method_bounds) {
    (void)object, (void)data, (void)arguments;
    instance *own = begin(user, count, 0, true);
    double bounds[4];
    if (!own) return nothing();
    sl_level_bounds(own->level, bounds);
    return of_points(bounds, 2);
}

METHOD(method_cell_corners) {
    (void)object, (void)data;
    instance *own = begin(user, count, 1, true);
    int32_t found;
    if (!own) return nothing();
    const double *corners =
        sl_level_cell_corners(own->level, (int32_t)number(arguments, 0), &found);
    return corners ? of_points(corners, found) : nothing();
}

METHOD(method_is_solid) {
    (void)object, (void)data;
    instance *own = begin(user, count, 1, true);
    return own ? of_bool(sl_level_is_solid(own->level, (int32_t)number(arguments, 0))) : nothing();
}

/* visible_polygon(x, y, range) */
METHOD(method_visible_polygon) {
    (void)object, (void)data;
    instance *own = begin(user, count, 3, true);
    if (!own) return nothing();
    int32_t found;
    const double *points =
        sl_level_visible_polygon(own->level, number(arguments, 0), number(arguments, 1), 0, 360,
                                 number(arguments, 2), &found);
    return of_points(points, found);
}

void GDN_EXPORT godot_gdnative_init(godot_gdnative_init_options *options) {
    api = options->api_struct;
    for (unsigned i = 0; i < api->num_extensions; i++)
        if (api->extensions[i]->type == GDNATIVE_EXT_NATIVESCRIPT)
            scripts = (const godot_gdnative_ext_nativescript_api_struct *)api->extensions[i];
}

void GDN_EXPORT godot_gdnative_terminate(godot_gdnative_terminate_options *options) {
    (void)options;
    api = NULL;
    scripts = NULL;
}

void GDN_EXPORT godot_nativescript_init(void *handle) {
    static const struct {
        const char *name;
        godot_variant (*call)(godot_object *, void *, void *, int, godot_variant **);
    } methods[] = {{"open", method_open},
                   {"set_door", method_set_door},
                   {"locate", method_locate},
                   {"can_see", method_can_see},
                   {"sees", method_sees},
                   {"look", method_look},
                   {"cell_count", method_cell_count},
                   {"bounds", method_bounds},
                   {"cell_corners", method_cell_corners},
                   {"is_solid", method_is_solid},
                   {"visible_polygon", method_visible_polygon}};
    const godot_instance_create_func begins = {create, NULL, NULL};
    const godot_instance_destroy_func ends = {destroy, NULL, NULL};
    const godot_method_attributes attributes = {GODOT_METHOD_RPC_MODE_DISABLED};
    scripts->godot_nativescript_register_class(handle, "SightlineLevel", "Reference", begins, ends);
    for (unsigned i = 0; i < sizeof methods / sizeof *methods; i++) {
        const godot_instance_method method = {methods[i].call, NULL, NULL};
        scripts->godot_nativescript_register_method(handle, "SightlineLevel", methods[i].name,
                                                    attributes, method);
    }
}
