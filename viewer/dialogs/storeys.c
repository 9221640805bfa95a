/// The list of storeys is that of a file with several maps: a choice without a format.
#include "dialogs/storeys.h"

#include "dialogs/import_dialog.h"
#include "dialogs/map_file.h"
#include "dialogs/opening.h"
#include "sightline/storeys.h"
#include "sightline/support.h"

#include <string.h>

bool storeys_is(const char *path) {
    return files_end_in(path, ".storeys");
}

static void open_storey(desk_state *desk, const char *building, const sl_storey *storey) {
    files_open_plan(desk, storey->path, false);
    ui_report(desk->ui, desk->context,
              files_set_text(desk->context, &desk->file.building, building));
    if (!desk->ui->steady) recent_add(desk->context, building);
}

typedef void take_storey(desk_state *desk, const char *building, const sl_storey *storey);

/// The list has names alone: the building is read again, as it is now.
static void take_named(desk_state *desk, const document_source *source, take_storey *take) {
    const char *name = source->options.map;
    sl_building building = {0};
    sl_status status = sl_building_read(desk->context, source->path, &building);
    if (status == SL_OK) {
        const size_t at = sl_building_find(&building, name, strlen(name));
        if (at == SL_NO_STOREY)
            status = sl_fail(desk->context, SL_BAD_INPUT, "%s: there is no storey %s any more",
                             source->path, name);
        else
            take(desk, source->path, &building.storeys[at]);
    }
    sl_building_destroy(desk->context, &building);
    if (status != SL_OK) map_file_check(desk, source->path, status);
}

static void open_named(desk_state *desk, const document_source *source) {
    take_named(desk, source, open_storey);
}

static void compare_storey(desk_state *desk, const char *building, const sl_storey *storey) {
    (void)building;
    desk->compare(desk, storey->path);
}

static void compare_named(desk_state *desk, const document_source *source) {
    take_named(desk, source, compare_storey);
}

/// The storey that is open is chosen at first.
static sl_status ask(desk_state *desk, const char *path, const sl_building *building,
                     void (*then)(desk_state *desk, const document_source *source)) {
    document_source source = {.path = (char *)(uintptr_t)path,
                              .options = sl_import_options_default()};
    const char *open = desk->document->source.path;
    sl_map_choice choice = {0};
    sl_status status = SL_OK;
    for (size_t i = 0; i < building->storey_count && status == SL_OK; i++) {
        const sl_storey *s = &building->storeys[i];
        status = sl_map_list_add(desk->context, &choice.maps, s->name, strlen(s->name));
        if (open && strcmp(open, s->path) == 0) source.options.map = s->name;
    }
    if (status == SL_OK) status = import_open(desk, &source, &choice, false, then);
    sl_map_choice_destroy(desk->context, &choice);
    return status;
}

sl_status storeys_open(desk_state *desk, const char *path) {
    sl_building building = {0};
    SL_TRY(sl_building_read(desk->context, path, &building));
    sl_status status = SL_OK;
    if (building.storey_count == 1)
        open_storey(desk, path, &building.storeys[0]);
    else
        status = ask(desk, path, &building, open_named);
    sl_building_destroy(desk->context, &building);
    return status;
}

sl_status storeys_compare(desk_state *desk, const char *path,
                          void (*take)(desk_state *desk, const char *path)) {
    sl_building building = {0};
    desk->compare = take;
    SL_TRY(sl_building_read(desk->context, path, &building));
    const sl_status status = ask(desk, path, &building, compare_named);
    sl_building_destroy(desk->context, &building);
    return status;
}

void storeys_choose(desk_state *desk) {
    char *path = NULL; // of its own: the desk's is replaced
    if (!desk->file.building) {
        ui_say(desk->ui, false, "this plan was not opened as a storey of a building");
        return;
    }
    sl_status status = files_set_text(desk->context, &path, desk->file.building);
    if (status == SL_OK) status = storeys_open(desk, path);
    map_file_check(desk, desk->file.building, status);
    sl_free(desk->context, path);
}
