/// Doors and starts.

SL_RUNTIME_API sl_runtime_name sl_runtime_door_name(const sl_runtime *runtime, uint32_t door) {
    sl_runtime_name name;
    slrt_text line;
    name.text = "";
    name.length = 0;
    if (door < runtime->door_count && slrt_find_statement(runtime, "door", &door, &line)) {
        const slrt_text word = slrt_take_word(&line);
        name.text = (const char *)word.at;
        name.length = (uint32_t)(word.end - word.at);
    }
    return name;
}

SL_RUNTIME_API uint32_t sl_runtime_find_door(const sl_runtime *runtime, const char *name) {
    slrt_text text, line;
    uint32_t door = 0;
    text.at = runtime->text;
    text.end = runtime->text + runtime->text_bytes;
    while (door < runtime->door_count && slrt_take_line(&text, &line)) {
        slrt_text word = slrt_take_word(&line);
        if (!slrt_word_is(&word, "door")) continue;
        word = slrt_take_word(&line);
        if (slrt_word_is(&word, name)) return door;
        door++;
    }
    return SL_RUNTIME_NO_DOOR;
}

SL_RUNTIME_API bool sl_runtime_door_open(const sl_runtime *runtime, uint32_t door) {
    slrt_text line, word;
    int i;
    if (door >= runtime->door_count || !slrt_find_statement(runtime, "door", &door, &line))
        return false;
    for (i = 0; i < 5; i++) word = slrt_take_word(&line); // its name and four coordinates
    word = slrt_take_word(&line);
    return !slrt_word_is(&word, "shut");
}

SL_RUNTIME_API uint32_t sl_runtime_door_segments(const sl_runtime *runtime, uint32_t door,
                                                 sl_runtime_segment *segments, uint32_t room) {
    uint32_t i, count = 0;
    for (i = 0; i < runtime->seam_count; i++) {
        const unsigned char *seam = runtime->seams + (size_t)i * 40;
        if (slrt_u32(seam + 32) != 1 || slrt_u32(seam + 36) != door) continue;
        if (count < room) {
            segments[count].x0 = slrt_f64(seam);
            segments[count].y0 = slrt_f64(seam + 8);
            segments[count].x1 = slrt_f64(seam + 16);
            segments[count].y1 = slrt_f64(seam + 24);
        }
        count++;
    }
    return count;
}

SL_RUNTIME_API uint32_t sl_runtime_start_count(const sl_runtime *runtime) {
    uint32_t left = UINT32_MAX;
    slrt_text line;
    slrt_find_statement(runtime, "start", &left, &line);
    return UINT32_MAX - left;
}

SL_RUNTIME_API bool sl_runtime_start(const sl_runtime *runtime, uint32_t start,
                                     sl_runtime_viewpoint *out) {
    sl_runtime_viewpoint found;
    slrt_text line;
    if (!slrt_find_statement(runtime, "start", &start, &line) || !slrt_read_start(line, &found))
        return false;
    *out = found;
    return true;
}
