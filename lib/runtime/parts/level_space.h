/// Cells, directed portals and vertices, as they stand in the file.

SL_RUNTIME_API sl_runtime_cell sl_runtime_get_cell(const sl_runtime *runtime, uint32_t cell) {
    sl_runtime_cell out;
    const unsigned char *at = runtime->cells + (size_t)cell * SLRT_CELL_BYTES;
#ifdef SLRT_BIG_ENDIAN
    out.first_vertex = slrt_u32(at);
    out.vertex_count = slrt_u32(at + 4);
    out.first_directed = slrt_u32(at + 8);
    out.directed_count = slrt_u32(at + 12);
#else
    memcpy(&out, at, sizeof out);
#endif
    return out;
}

SL_RUNTIME_API sl_runtime_directed_portal sl_runtime_get_directed_portal(const sl_runtime *runtime,
                                                                         uint32_t directed) {
    sl_runtime_directed_portal out;
    const unsigned char *at = runtime->directed + (size_t)directed * SLRT_DIRECTED_BYTES;
#ifdef SLRT_BIG_ENDIAN
    out.portal = slrt_u32(at);
    out.cell = slrt_u32(at + 4);
    out.left[0] = slrt_f64(at + 8);
    out.left[1] = slrt_f64(at + 16);
    out.right[0] = slrt_f64(at + 24);
    out.right[1] = slrt_f64(at + 32);
#else
    memcpy(&out, at, sizeof out);
#endif
    return out;
}

SL_RUNTIME_API void sl_runtime_get_vertex(const sl_runtime *runtime, uint32_t vertex, double *x,
                                          double *y) {
    const unsigned char *at = runtime->vertices + (size_t)vertex * SLRT_VERTEX_BYTES;
    *x = slrt_f64(at);
    *y = slrt_f64(at + 8);
}
