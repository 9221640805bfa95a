/// The map's things: doors, starts, objects, paths and mirrors.

/// The name that a door, an object or a path begins with.
static sl_runtime_name slrt_name(const sl_runtime *rt, const unsigned char *item) {
    sl_runtime_name name;
    name.text = (const char *)rt->names + slrt_u32(item);
    name.length = slrt_u32(item + 4);
    return name;
}

static sl_runtime_segment slrt_segment(const unsigned char *at) {
    sl_runtime_segment segment;
    segment.x0 = slrt_f64(at);
    segment.y0 = slrt_f64(at + 8);
    segment.x1 = slrt_f64(at + 16);
    segment.y1 = slrt_f64(at + 24);
    return segment;
}

static sl_runtime_name slrt_door(const sl_runtime *rt, uint32_t door, bool *open) {
    const unsigned char *item;
#ifndef SL_RUNTIME_WITHOUT_OLD_FILES
    if (rt->text) return slrt_text_door(rt, door, open);
#endif
    item = rt->doors + (size_t)door * SLRT_DOOR_BYTES;
    *open = slrt_u32(item + 8) & 1;
    return slrt_name(rt, item);
}

SL_RUNTIME_API sl_runtime_name sl_runtime_door_name(const sl_runtime *runtime, uint32_t door) {
    sl_runtime_name none;
    bool open;
    none.text = "";
    none.length = 0;
    return door < runtime->door_count ? slrt_door(runtime, door, &open) : none;
}

SL_RUNTIME_API uint32_t sl_runtime_find_door(const sl_runtime *runtime, const char *name) {
    uint32_t door, i;
    for (door = 0; door < runtime->door_count; door++) {
        const sl_runtime_name own = sl_runtime_door_name(runtime, door);
        for (i = 0; i < own.length && name[i] && name[i] == own.text[i];) i++;
        if (i == own.length && !name[i]) return door;
    }
    return SL_RUNTIME_NO_DOOR;
}

SL_RUNTIME_API bool sl_runtime_door_open(const sl_runtime *runtime, uint32_t door) {
    bool open = false;
    if (door < runtime->door_count) slrt_door(runtime, door, &open);
    return open;
}

SL_RUNTIME_API sl_runtime_door_kind sl_runtime_get_door_kind(const sl_runtime *runtime,
                                                             uint32_t door) {
    uint32_t bits;
    if (door >= runtime->door_count || !runtime->doors) return SL_RUNTIME_DOOR;
    bits = slrt_u32(runtime->doors + (size_t)door * SLRT_DOOR_BYTES + 8);
    return bits & 2 ? SL_RUNTIME_BREAKABLE : bits & 4 ? SL_RUNTIME_SITE : SL_RUNTIME_DOOR;
}

SL_RUNTIME_API uint32_t sl_runtime_door_segments(const sl_runtime *runtime, uint32_t door,
                                                 sl_runtime_segment *segments, uint32_t room) {
    uint32_t i, count = 0;
    for (i = 0; i < runtime->seam_count; i++) {
        const unsigned char *seam = runtime->seams + (size_t)i * 40;
        if (slrt_u32(seam + 32) != 1 || slrt_u32(seam + 36) != door) continue;
        if (count < room) segments[count] = slrt_segment(seam);
        count++;
    }
    return count;
}

SL_RUNTIME_API bool sl_runtime_wall(const sl_runtime *runtime, uint32_t wall,
                                    sl_runtime_segment *out) {
    if (!runtime->walls || wall >= runtime->wall_count) return false;
    *out = slrt_segment(runtime->walls + (size_t)wall * 32);
    return true;
}

SL_RUNTIME_API uint32_t sl_runtime_start_count(const sl_runtime *runtime) {
    return runtime->start_count;
}

SL_RUNTIME_API bool sl_runtime_start(const sl_runtime *runtime, uint32_t start,
                                     sl_runtime_viewpoint *out) {
    const unsigned char *item;
    if (start >= runtime->start_count) return false;
#ifndef SL_RUNTIME_WITHOUT_OLD_FILES
    if (runtime->text) return slrt_text_start(runtime, start, out);
#endif
    item = runtime->starts + (size_t)start * SLRT_START_BYTES;
    out->x = slrt_f64(item);
    out->y = slrt_f64(item + 8);
    out->heading = slrt_f64(item + 16);
    return true;
}

SL_RUNTIME_API bool sl_runtime_object(const sl_runtime *runtime, uint32_t object,
                                      sl_runtime_name *name, sl_runtime_segment *box) {
    const unsigned char *item;
    if (object >= runtime->object_count) return false;
    item = runtime->objects + (size_t)object * SLRT_OBJECT_BYTES;
    *name = slrt_name(runtime, item);
    *box = slrt_segment(item + 8);
    return true;
}

SL_RUNTIME_API bool sl_runtime_path(const sl_runtime *runtime, uint32_t path, sl_runtime_name *name,
                                    uint32_t *point_count) {
    const unsigned char *item;
    if (path >= runtime->path_count) return false;
    item = runtime->paths + (size_t)path * SLRT_PATH_BYTES;
    *name = slrt_name(runtime, item);
    *point_count = slrt_u32(item + 12);
    return true;
}

SL_RUNTIME_API void sl_runtime_path_points(const sl_runtime *runtime, uint32_t path,
                                           double *points) {
    const unsigned char *item, *at;
    uint32_t i;
    if (path >= runtime->path_count) return;
    item = runtime->paths + (size_t)path * SLRT_PATH_BYTES;
    at = runtime->path_points + (size_t)slrt_u32(item + 8) * SLRT_VERTEX_BYTES;
    for (i = 0; i < 2 * slrt_u32(item + 12); i++) points[i] = slrt_f64(at + (size_t)i * 8);
}

SL_RUNTIME_API bool sl_runtime_mirror(const sl_runtime *runtime, uint32_t mirror,
                                      sl_runtime_segment *segment, bool *one_sided) {
    const unsigned char *item;
    if (mirror >= runtime->mirror_count) return false;
    item = runtime->mirror_lines + (size_t)mirror * SLRT_MIRROR_BYTES;
    *segment = slrt_segment(item);
    *one_sided = slrt_u64(item + 32) != 0;
    return true;
}
