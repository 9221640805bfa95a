/// DXF (Autodesk, DXF Reference). A drawing is lines in pairs, a group code and a value, in
/// sections HEADER, TABLES, BLOCKS and ENTITIES. The pairs are read first (dxf_sections.c); then
/// every entity that is walls is drawn (dxf_draw.c). Then layers are chosen by what they mean
/// (contents.h). Here walls get names and a unit, and the notes say what was taken.
#include "io/dxf/dxf.h"

#include "io/io_formats.h"
#include "io/parts/plan_unit.h"
#include "map/source.h"
#include "map/unit.h"

// --- names for walls

/// Adds a part to a label: "layer WALLS, handle 1F".
static void add_part(char *label, size_t size, const char *what, sli_word name) {
    const size_t used = strlen(label);
    if (name.length)
        snprintf(label + used, size - used, "%s%s %s", used ? ", " : "", what, sli_show(name).text);
}

/// Names the entities that were drawn by their layer and handle; those of a block by its name too.
static sl_status name_walls(sli_dxf *dxf) {
    sli_word block = {"", 0};
    for (size_t i = 0; i < dxf->pairs.count; i++) {
        const sli_dxf_pair *pair = sli_dxf_at(dxf, i);
        if (pair->code != 0) continue;
        const sli_dxf_range entity = sli_dxf_entity(dxf, i, dxf->pairs.count);
        if (sli_word_is(pair->value, "BLOCK")) block = sli_dxf_text(dxf, entity, 2);
        if (sli_word_is(pair->value, "ENDBLK")) block.length = 0;
        if (!sl_bits_has(dxf->walls, i)) continue;
        char label[SL_LINE_TEXT] = "";
        add_part(label, sizeof label, "block", block);
        add_part(label, sizeof label, "layer", sli_dxf_text(dxf, entity, 8));
        add_part(label, sizeof label, "handle", sli_dxf_text(dxf, entity, 5));
        if (*label) SL_TRY(sli_map_add_label(dxf->context, dxf->pen.map, pair->line, label));
    }
    return SL_OK;
}

// --- the drawing

/// A layer that is asked for and not there is a mistake worth telling of.
static sl_status check_layers(const sli_dxf *dxf) {
    const char *list = dxf->contents.roles ? dxf->contents.roles : dxf->options->layers;
    sli_meaning means;
    for (sli_word name; list && sli_roles_next(&list, &name, &means);) {
        bool known = dxf->layers.count == 0;
        for (size_t i = 0; i < dxf->layers.count; i++)
            known |= sli_dxf_same_name(dxf->layers.items[i].name, name);
        if (known) continue;
        sli_name_list there = {.full = false};
        for (size_t i = 0; i < dxf->layers.count; i++)
            sli_name_list_add(&there, dxf->layers.items[i].name);
        return sli_fail_layer(dxf->context, dxf->name, name, "drawing", &there);
    }
    return SL_OK;
}

static const char *unit_name(int unit) {
    return unit >= 0 && unit < SLI_UNITS ? sli_units[unit].name : "unusual";
}

static void set_unit(const sli_dxf *dxf, const char *sign) {
    snprintf(dxf->pen.map->unit, sizeof dxf->pen.map->unit, "%s", sign);
}

/// The number of a unit that is asked for.
static sl_status find_unit(const sli_dxf *dxf, const char *sign, size_t *unit) {
    size_t i = 0;
    while (i < SLI_UNITS && !(sli_units[i].known && strcmp(sli_units[i].sign, sign) == 0)) i++;
    *unit = i;
    if (i < SLI_UNITS) return SL_OK;
    return sl_fail(dxf->context, SL_BAD_ARGUMENT,
                   "there is no unit '%s'; choose from mm, cm, m, km, in, ft, yd", sign);
}

/// Has the pen draw in the unit that is asked for: "m", or "mm=m" for a drawing that is in mm,
/// whatever it says itself.
static sl_status take_unit(sli_dxf *dxf) {
    const char *word = dxf->options->unit, *told = word ? strchr(word, '=') : NULL;
    size_t from = dxf->unit >= 0 && dxf->unit < SLI_UNITS ? (size_t)dxf->unit : 0, to;
    if (told) {
        char own[16];
        snprintf(own, sizeof own, "%.*s", (int)(told - word < 16 ? told - word : 16), word);
        SL_TRY(find_unit(dxf, own, &from));
        word = told + 1;
    }
    dxf->pen.map->source.drawing_unit = (int)from;
    if (!word) {
        set_unit(dxf, sli_units[from].sign);
        return SL_OK;
    }
    SL_TRY(find_unit(dxf, word, &to));
    if (!from)
        return sl_fail(dxf->context, SL_BAD_ARGUMENT,
                       "%s: the drawing's own unit is %s, so it cannot be turned into %s; if it is "
                       "in mm, say --unit mm=%s",
                       dxf->name, unit_name(dxf->unit), sli_units[to].name, word);
    set_unit(dxf, word);
    if (from == to) return SL_OK;
    dxf->pen.map->source.drawing_unit = (int)to;
    const double scale = sli_units[from].metres / sli_units[to].metres;
    dxf->pen.affine = (sli_affine){.xx = scale, .yy = scale};
    dxf->pen.map->source.transform = (sl_transform){.scale = 1 / scale};
    return SL_OK;
}

/// The comment of a file of our own, with the sum of its digits; a drawing that is turned into
/// another unit has other numbers. NULL for none. To be freed.
static sl_status find_mark(const sli_dxf *dxf, char **mark) {
    static const char word[] = "sightline-digits ";
    const size_t length = sizeof word - 1;
    for (size_t i = dxf->pairs.count; i-- > 0 && !dxf->options->unit && !*mark;) {
        const sli_dxf_pair *pair = sli_dxf_at(dxf, i);
        if (pair->code != 999 || pair->value.length < length ||
            memcmp(pair->value.at, word, length) != 0)
            continue;
        *mark = sl_copy_text(dxf->context, pair->value.at + length, pair->value.length - length);
        if (!*mark) return SL_NO_MEMORY;
    }
    return SL_OK;
}

static sl_status draw_drawing(sli_dxf *dxf, const char *text, size_t size) {
    SL_TRY(sli_dxf_read(dxf, text, size));
    SL_TRY(check_layers(dxf));
    SL_TRY(take_unit(dxf));
    SL_TRY(sli_dxf_check_amount(dxf));
    dxf->walls = sl_alloc_array(dxf->context, sl_bits_words(dxf->pairs.count), sizeof(sl_bits));
    if (!dxf->walls) return SL_NO_MEMORY;
    return sli_dxf_draw(dxf, dxf->entities, (sli_word){"", 0}, 0);
}

/// What was taken, and what was left out.
static void note_drawing(const sli_dxf *dxf) {
    char kinds[SLI_DXF_OTHERS][96];
    sli_tally left[5 + SLI_DXF_OTHERS];
    size_t count = 0;
    left[count++] = (sli_tally){dxf->other_layers, "on another layer", "on other layers"};
    for (size_t i = 0; i < dxf->others_count; i++) {
        const sli_dxf_other *other = &dxf->others[i];
        snprintf(kinds[i], sizeof kinds[i], "%.24s%s%.60s", sli_show(other->kind).text,
                 other->layer.length ? " on " : "", sli_show(other->layer).text);
        left[count++] = (sli_tally){other->count, kinds[i], kinds[i]};
    }
    left[count++] = (sli_tally){dxf->other_kinds, "that is no wall either", "that are no walls"};
    left[count++] =
        (sli_tally){dxf->on_paper, "on a layout (paper space)", "on layouts (paper space)"};
    left[count++] = (sli_tally){dxf->out_of_plane, "out of the plane", "out of the plane"};
    left[count++] = (sli_tally){dxf->pen.points, "line of no length", "lines of no length"};
    const char *asked = dxf->options->unit;
    char without[SLI_TALLY_TEXT];
    sl_note(dxf->context, "%s: %zu entit%s %zu wall%s%s; unit: %s%s%s", dxf->name, dxf->drawn,
            dxf->drawn == 1 ? "y gives" : "ies give", dxf->pen.walls,
            dxf->pen.walls == 1 ? "" : "s", sli_tally_write("; left out: ", left, count, without),
            unit_name(dxf->unit),
            asked ? strchr(asked, '=') ? ", read as " : ", converted to " : "", asked ? asked : "");
    if (!dxf->drawn && dxf->options->layers)
        sl_note(dxf->context,
                "%s: nothing on the layers %s is a wall; sightline info %s lists all layers",
                dxf->name, dxf->options->layers, dxf->name);
    sli_dxf_note_names(dxf);
    sli_faults_note(dxf->context, dxf->name, &dxf->faults);
    sli_layers_note(dxf->context, dxf->name, dxf->pen.map);
}

/// Whether the unit fits, unless an option says which one it is.
static void tell_unit(const sli_dxf *dxf) {
    const char *asked = dxf->options->unit;
    const bool named = dxf->unit >= 0 && dxf->unit < SLI_UNITS;
    const sli_plan_size plan = {.unit = named ? dxf->unit : 0,
                                .scale = dxf->pen.affine.xx,
                                .door = dxf->contents.door,
                                .doors = dxf->contents.doors,
                                .building = dxf->contents.walls_named};
    if (dxf->options->sized || (asked && strchr(asked, '='))) return;
    sli_plan_unit_tell(dxf->context, dxf->name, dxf->pen.map, &plan);
}

/// A metre in the map's unit; 0 for unknown.
static double metre_of(const sl_map *map) {
    const double metres = sli_units[map->source.drawing_unit].metres;
    return metres > 0 ? 1 / metres : 0;
}

/// SL_BAD_INPUT for a drawing with a picture, and nothing that is drawn.
static sl_status refuse_picture(const sli_dxf *dxf) {
    static const char *const kinds[] = {"IMAGE", "OLE2FRAME", "PDFUNDERLAY"};
    for (size_t i = dxf->entities.begin; !dxf->drawn && i < dxf->entities.end; i++)
        for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
            if (sli_dxf_at(dxf, i)->code == 0 && sli_word_is(sli_dxf_at(dxf, i)->value, kinds[k]))
                return sl_fail_at(dxf->context, dxf->name, sli_dxf_at(dxf, i)->line,
                                  "the drawing has a picture (%s) and no walls: if the plan is in "
                                  "it, save it as a PNG file, and read that",
                                  kinds[k]);
    return SL_OK;
}

static sl_status read_drawing(sli_dxf *dxf, const char *text, size_t size) {
    SL_TRY(draw_drawing(dxf, text, size));
    SL_TRY(refuse_picture(dxf));
    SL_TRY(name_walls(dxf));
    SL_TRY(sli_contents_choose(&dxf->contents, metre_of(dxf->pen.map), &dxf->pen));
    dxf->drawn -= dxf->contents.left_out;
    char *mark = NULL;
    SL_TRY(find_mark(dxf, &mark));
    dxf->pen.map->precision =
        sli_marked_precision(dxf->pen.map, dxf->pen.finest, mark, dxf->pen.sum);
    sl_free(dxf->context, mark);
    note_drawing(dxf);
    tell_unit(dxf);
    return SL_OK;
}

static void drawing_destroy(sli_dxf *dxf) {
    sl_free(dxf->context, dxf->pairs.items);
    sl_free(dxf->context, dxf->blocks.items);
    sl_free(dxf->context, dxf->layers.items);
    sl_free(dxf->context, dxf->walls);
    sl_free(dxf->context, dxf->filters.items);
    sl_free(dxf->context, dxf->text.items);
    sl_free(dxf->context, dxf->names);
    sli_contents_destroy(&dxf->contents);
}

sl_status sli_map_read_dxf(sl_context *context, const char *name, const char *text, size_t size,
                           const sl_import_options *options, sl_map *map) {
    bool large;
    const sl_import_options own = sli_drawing_options(options, &large);
    sl_map read = {0};
    sli_dxf dxf = {.context = context,
                   .name = name,
                   .options = &own,
                   .contents = {.context = context,
                                .file = name,
                                .options = &own,
                                .large = large,
                                .roles = sli_drawing_roles(options)},
                   .pen = {.context = context,
                           .name = name,
                           .map = &read,
                           .affine = SLI_AFFINE_NONE,
                           .tolerance = own.tolerance}};
    const sl_status status = read_drawing(&dxf, text, size);
    drawing_destroy(&dxf);
    if (status == SL_OK)
        *map = read;
    else
        sl_map_destroy(context, &read);
    return status;
}

void sl_drawing_layers_destroy(sl_context *context, sl_drawing_layers *layers) {
    for (size_t i = 0; i < layers->count; i++) sl_free(context, layers->items[i].name);
    sl_free(context, layers->items);
    *layers = (sl_drawing_layers){0};
}

static sl_status copy_layers(const sli_dxf *dxf, const sl_drawing_layers *drawn,
                             sl_drawing_layers *out) {
    out->items = sl_alloc_array(dxf->context, dxf->layers.count, sizeof *out->items);
    if (!out->items) return SL_NO_MEMORY;
    for (size_t i = 0; i < dxf->layers.count; i++) {
        const sli_dxf_layer *from = &dxf->layers.items[i];
        sl_drawing_layer *to = &out->items[i];
        *to = (sl_drawing_layer){
            sl_copy_text(dxf->context, from->name.at, from->name.length), from->entities, from->on,
            from->on ? sli_contents_role(drawn, from->name) : sli_role_name(SLI_MEANS_OTHER)};
        if (!to->name) return SL_NO_MEMORY;
        out->count++;
    }
    return SL_OK;
}

sl_status sl_drawing_layers_dxf(sl_context *context, const char *name, const char *text,
                                size_t size, sl_drawing_layers *out) {
    const sl_import_options options = sl_import_options_default();
    sl_drawing_layers read = {0}, drawn = {0};
    sl_map map = {0};
    sli_dxf dxf = {
        .context = context,
        .name = name,
        .options = &options,
        .contents = {.context = context, .file = name, .options = &options},
        .pen = {.context = context, .name = name, .map = &map, .affine = SLI_AFFINE_NONE}};
    sl_status status = draw_drawing(&dxf, text, size);
    if (status == SL_OK) status = sli_contents_list(&dxf.contents, &map, metre_of(&map), &drawn);
    if (status == SL_OK) status = copy_layers(&dxf, &drawn, &read);
    sl_drawing_layers_destroy(context, &drawn);
    drawing_destroy(&dxf);
    sl_map_destroy(context, &map);
    if (status == SL_OK)
        *out = read;
    else
        sl_drawing_layers_destroy(context, &read);
    return status;
}
