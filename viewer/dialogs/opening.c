/// How a file is opened: what it leaves open is asked, and a failure gets a dialog.
#include "dialogs/opening.h"

#include "dialogs/browser.h"
#include "dialogs/import_dialog.h"
#include "dialogs/map_file.h"
#include "dialogs/storeys.h"
#include "document/drawings.h"

#include <stdio.h>
#include <string.h>

static void keep_useful(sl_import_options *options, unsigned takes) {
    const sl_import_options usual = sl_import_options_default();
    if (!(takes & SL_TAKES_SLICE)) options->has_slice = false;
    if (!(takes & SL_TAKES_LAYERS)) options->layers = NULL;
    if (!(takes & SL_TAKES_STARTS)) options->start_names = NULL;
    if (!(takes & SL_TAKES_TOLERANCE)) options->tolerance = usual.tolerance;
    if (!(takes & SL_TAKES_UNIT)) options->unit = NULL;
    if (!(takes & SL_TAKES_THRESHOLD)) options->threshold = usual.threshold;
    if (!(takes & SL_TAKES_DOORS)) options->doors = false;
    if (!(takes & SL_TAKES_CELLS)) options->cells = false;
}

/// Takes what was chosen for a drawing before, unless the caller says how to read it.
static sl_status recall(sl_context *context, document_source *source) {
    const sl_import_options *o = &source->options;
    sl_status status = SL_OK;
    source->known = o->layers || o->unit || o->entrance > 0 || source->has_start;
    if (!source->known && drawing_is(source->path))
        source->known = drawing_recall(context, source, &status);
    return status;
}

/// Whether the file has to be asked about.
static bool is_open_question(const document_source *source, const sl_map_choice *choice) {
    return (choice->maps.count > 1 && !source->options.map) ||
           (choice->layers_unsaid && !source->options.layers);
}

/// A building is opened at another place; what is opened here is of none.
static bool is_of_building(desk_state *desk, const char *path, sl_status *status) {
    const bool is = storeys_is(path);
    *status =
        is ? storeys_open(desk, path) : files_set_text(desk->context, &desk->file.building, NULL);
    return is;
}

void files_open_plan(desk_state *desk, const char *path, bool ask) {
    document_source given = {.path = (char *)(uintptr_t)path, .options = desk->options};
    document_source source = {0};
    sl_map_choice choice = {0};
    sl_status status = files_look(desk->context, &given, &choice);
    if (choice.format) keep_useful(&given.options, given.takes);
    if (status == SL_OK) status = document_source_copy(desk->context, &given, &source);
    if (status == SL_OK && !desk->ui->steady) status = recall(desk->context, &source);
    if (status == SL_OK && choice.format && (ask || is_open_question(&source, &choice)))
        status = import_open(desk, &source, &choice, ask, map_file_start);
    else if (status == SL_OK)
        map_file_start(desk, &source);
    map_file_check(desk, path, status);
    document_source_destroy(desk->context, &source);
    sl_map_choice_destroy(desk->context, &choice);
}

void files_open(desk_state *desk, const char *path, bool ask) {
    sl_status status;
    if (!is_of_building(desk, path, &status) && status == SL_OK)
        files_open_plan(desk, path, ask);
    else
        map_file_check(desk, path, status);
}

void files_drop(desk_state *desk, const char *path) {
    if (dialog_clear(&desk->dialog))
        files_open(desk, path, false);
    else
        ui_say(desk->ui, true, "answer the question first, then drop the file again");
}

sl_status files_open_source(desk_state *desk, const document_source *given, bool ask) {
    document_source source;
    sl_map_choice choice = {0};
    sl_status status;
    if (is_of_building(desk, given->path, &status) || status != SL_OK) return status;
    SL_TRY(document_source_copy(desk->context, given, &source));
    status = files_look(desk->context, &source, &choice);
    if (status == SL_OK && ask) status = recall(desk->context, &source);
    if (status == SL_OK && ask && choice.format && is_open_question(&source, &choice))
        status = import_open(desk, &source, &choice, false, map_file_start);
    else if (status == SL_OK)
        status = document_open(desk->context, desk->document, &source);
    document_source_destroy(desk->context, &source);
    sl_map_choice_destroy(desk->context, &choice);
    return status;
}

void files_open_again(desk_state *desk, const sl_import_options *options) {
    document_source source = desk->document->source;
    if (!source.path) return;
    source.options = *options;
    source.again = true;
    map_file_start(desk, &source);
}

void files_import_again(desk_state *desk) {
    document_source source = desk->document->source;
    sl_map_choice choice = {0};
    if (!source.path || document_is_baked(source.path)) {
        ui_say(desk->ui, false, "this map was not read from a file that has options");
        return;
    }
    sl_status status = files_look(desk->context, &source, &choice);
    if (status == SL_OK) status = import_open(desk, &source, &choice, true, map_file_start);
    map_file_check(desk, source.path, status);
    sl_map_choice_destroy(desk->context, &choice);
}

void files_ask_once(desk_state *desk) {
    const document_source *source = &desk->document->source;
    if (!desk->ui->steady && !source->known && drawing_is(source->path)) files_import_again(desk);
}

void files_browse(desk_state *desk) {
    browser_open(desk, BROWSE_MAPS, files_open);
}
