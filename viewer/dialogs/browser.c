/// The dialog that opens and saves files.
///
/// The field holds a path. The list follows it: it shows the folder of the path, and chooses the
/// first entry that begins as the name does. A choice in the list goes into the field. So there is
/// one thing to act on, the path in the field, however it came there.
#include "dialogs/browser.h"

#include "dialogs/folder_list.h"
#include "dialogs/question.h"
#include "document/files.h"
#include "sightline/draw.h"
#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

typedef enum browser_place { PLACE_FOLDER, PLACE_RECENT, PLACE_SAMPLES } browser_place;

typedef struct browser_state {
    bool saves;
    browse_kind kind;
    browser_open_file *open; ///< these two: what is done with the path
    browser_save_file *save;
    browser_place place;
    char folder[PATH_TEXT]; ///< that is listed; where there is none, that names begin from
    text_field path;
    folder_list files;
    dialog_list list;
    folder_sort sort;
    bool down, all;
    char problem[256]; ///< "" for none
} browser_state;

/// What differs by kind. The first ending is put to a name that has none.
static const struct kind_row {
    const char *open, *save, *none, *wrong, *endings[3];
    folder_filter opened, saved;
} kinds[] = {
    [BROWSE_MAPS] = {"Open a map",
                     "Save the map",
                     "No map in this folder. 'All files' shows the rest.",
                     "Names end in .map (map text) or .slv (baked).",
                     {".map", ".slv"},
                     FILTER_READABLE,
                     FILTER_SAVED},
    [BROWSE_PLANS] = {"Choose a plan to compare with",
                      NULL,
                      "No map in this folder. 'All files' shows the rest.",
                      NULL,
                      {NULL},
                      FILTER_READABLE,
                      FILTER_READABLE},
    [BROWSE_TABLES] = {"Open a table of cameras",
                       "Save a table of cameras",
                       "No table in this folder. 'All files' shows the rest.",
                       "Names of tables end in .csv or .txt.",
                       {".csv", ".txt"},
                       FILTER_TABLES,
                       FILTER_TABLES},
    [BROWSE_VALUES] = {NULL,
                       "Save the table",
                       "No table in this folder.",
                       "Names of tables end in .csv or .txt.",
                       {".csv", ".txt"},
                       FILTER_TABLES,
                       FILTER_TABLES},
    [BROWSE_PICTURES] = {NULL,
                         "Save a picture of the plan",
                         "No picture in this folder.",
                         "Names of pictures end in .png, .svg or .pdf.",
                         {".png", ".svg", ".pdf"},
                         FILTER_PICTURES,
                         FILTER_PICTURES},
    [BROWSE_SHEETS] = {NULL,
                       "Save the sheet of paper",
                       "No sheet in this folder.",
                       "Names of sheets end in .pdf or .svg.",
                       {".pdf", ".svg"},
                       FILTER_PICTURES,
                       FILTER_PICTURES},
    [BROWSE_FRAMES] = {NULL,
                       "Save the way: pictures in a new folder",
                       "No picture in this folder.",
                       NULL,
                       {NULL},
                       FILTER_PICTURES,
                       FILTER_PICTURES},
};

enum {
    PATH_FIELD = DIALOG_OWN,
    LIST,
    RECENT,
    SAMPLES,
    HOME,
    PARENT,
    HEAD_NAME,
    HEAD_SIZE,
    HEAD_CHANGED,
    ALL_FILES,
    OPTIONS,
};

static browser_state *state_of(desk_state *desk) {
    if (!desk->dialog.browser)
        desk->dialog.browser = sl_alloc_array(desk->context, 1, sizeof(browser_state));
    return desk->dialog.browser;
}

void browser_destroy(desk_state *desk) {
    if (!desk->dialog.browser) return;
    folder_list_clear(desk->context, &desk->dialog.browser->files);
    sl_free(desk->context, desk->dialog.browser);
    desk->dialog.browser = NULL;
}

// --- the list

static bool is_there(const char *path) {
    struct stat info;
    return stat(path, &info) == 0;
}

static sl_status add_recent(desk_state *desk, browser_state *b) {
    sl_map_list recent = {0};
    sl_status status = recent_list(desk->context, &recent);
    for (size_t i = 0; i < recent.count && status == SL_OK; i++)
        status =
            folder_list_add(desk->context, &b->files, recent.names[i], files_base(recent.names[i]));
    sl_map_list_destroy(desk->context, &recent);
    return status;
}

static void refill_list(desk_state *desk, browser_state *b) {
    char samples[PATH_TEXT];
    sl_status status = SL_OK;
    folder_list_clear(desk->context, &b->files);
    if (b->place == PLACE_RECENT)
        status = add_recent(desk, b);
    else if (b->place == PLACE_SAMPLES && folder_of_samples(samples, sizeof samples))
        status = folder_list_add_all(desk->context, &b->files, samples);
    else if (b->place == PLACE_FOLDER)
        status = folder_list_read(desk->context, &b->files, b->folder,
                                  b->all     ? FILTER_ALL
                                  : b->saves ? kinds[b->kind].saved
                                             : kinds[b->kind].opened);
    b->problem[0] = '\0';
    if (status != SL_OK)
        snprintf(b->problem, sizeof b->problem, "%s", sl_context_message(desk->context));
    // What was opened last stays in that order until a head is clicked.
    if (b->place != PLACE_RECENT || b->sort != SORT_NAME || b->down)
        folder_list_sort(&b->files, b->sort, b->down);
    b->list = (dialog_list){.at = SIZE_MAX, .count = b->files.entries.count, .page = b->list.page};
}

/// Puts a folder in front of a name.
static void set_path(browser_state *b, const char *folder, const char *name) {
    char path[PATH_TEXT + 300];
    snprintf(path, sizeof path, "%s%s%s", folder, folder[1] ? "/" : "", name);
    field_set(&b->path, path);
}

/// Lists a folder; the field has it, with the name that is to be saved.
static void enter_folder(desk_state *desk, browser_state *b, const char *folder) {
    char name[TITLE_TEXT] = "";
    char *full = realpath(folder, NULL);
    if (b->saves) snprintf(name, sizeof name, "%.300s", files_base(b->path.text));
    if (full && strlen(full) < PATH_TEXT) snprintf(b->folder, sizeof b->folder, "%s", full);
    free(full);
    b->place = PLACE_FOLDER;
    refill_list(desk, b);
    set_path(b, b->folder, name);
}

// --- the path

/// The field's path as the system needs it: "~/" is the home folder, other names begin from the
/// folder that is listed.
static void resolve_path(const browser_state *b, const char *text, char path[2 * PATH_TEXT]) {
    const char *home = getenv("HOME");
    if (text[0] == '~' && (text[1] == '/' || !text[1]) && home)
        snprintf(path, 2 * PATH_TEXT, "%s%s", home, text + 1);
    else if (text[0] == '/')
        snprintf(path, 2 * PATH_TEXT, "%s", text);
    else
        snprintf(path, 2 * PATH_TEXT, "%s/%s", b->folder, text);
}

/// The first entry whose name begins so; SIZE_MAX for none.
static size_t find_name(const browser_state *b, const char *name) {
    const size_t length = strlen(name);
    if (!length) return SIZE_MAX;
    for (size_t i = 0; i < b->files.entries.count; i++)
        if (strncmp(b->files.entries.items[i].name, name, length) == 0) return i;
    for (size_t i = 0; i < b->files.entries.count; i++)
        if (strncasecmp(b->files.entries.items[i].name, name, length) == 0) return i;
    return SIZE_MAX;
}

/// The list follows the field.
static void follow_field(desk_state *desk, browser_state *b) {
    char path[2 * PATH_TEXT];
    resolve_path(b, b->path.text, path);
    char *slash = strrchr(path, '/');
    char name[PATH_TEXT];
    snprintf(name, sizeof name, "%s", slash + 1);
    slash[slash == path] = '\0';
    char *folder = realpath(path, NULL);
    const bool other = folder && strlen(folder) < PATH_TEXT && is_folder(folder) &&
                       (b->place != PLACE_FOLDER || strcmp(folder, b->folder) != 0);
    if (other && strchr(b->path.text, '/')) {
        snprintf(b->folder, sizeof b->folder, "%s", folder);
        b->place = PLACE_FOLDER;
        refill_list(desk, b);
    }
    free(folder);
    b->problem[0] = '\0';
    b->list.at = SIZE_MAX;
    // Samples have names with folders.
    const size_t found = find_name(b, b->place == PLACE_SAMPLES ? b->path.text : name);
    if (found != SIZE_MAX) dialog_list_go(&b->list, found);
}

void browser_edited(desk_state *desk, int id) {
    browser_state *b = desk->dialog.browser;
    if (id == PATH_FIELD) follow_field(desk, b);
    if (id != LIST || b->list.at >= b->files.entries.count) return;
    const folder_entry *entry = &b->files.entries.items[b->list.at];
    b->problem[0] = '\0';
    field_set(&b->path, entry->path);
    if (entry->folder) field_insert(&b->path, "/");
}

/// Adds to the name what all entries that begin so have in common. False where that is nothing.
static bool complete_name(desk_state *desk, browser_state *b) {
    follow_field(desk, b);
    const char *name = files_base(b->path.text);
    const size_t typed = strlen(name), first = find_name(b, name);
    if (first == SIZE_MAX || b->place != PLACE_FOLDER) return false;
    const folder_entry *found = &b->files.entries.items[first];
    size_t same = strlen(found->name), count = 0;
    for (size_t i = 0; i < b->files.entries.count; i++) {
        const char *other = b->files.entries.items[i].name;
        size_t k = 0;
        if (strncmp(other, found->name, typed) != 0) continue;
        while (k < same && other[k] == found->name[k]) k++;
        same = k;
        count++;
    }
    while (same > typed && ((unsigned char)found->name[same] & 0xc0) == 0x80) same--;
    const bool folder = count == 1 && found->folder;
    if (same <= typed && !folder) return false;
    char whole[2 * PATH_TEXT];
    const size_t before = strlen(b->path.text) - typed;
    snprintf(whole, sizeof whole, "%.*s%.*s%s", (int)before, b->path.text, (int)same, found->name,
             folder ? "/" : "");
    field_set(&b->path, whole);
    follow_field(desk, b);
    return true;
}

bool browser_key(desk_state *desk, const char *key) {
    browser_state *b = desk->dialog.browser;
    const int focus = desk->dialog.focus[desk->dialog.depth - 1];
    if (strcmp(key, "Tab") == 0 && focus == PATH_FIELD) return complete_name(desk, b);
    if (strcmp(key, "Ctrl+Up") != 0) return false;
    browser_act(desk, PARENT);
    return true;
}

// --- what it does

static void save_now(desk_state *desk, const char *path) {
    dialog_pop(&desk->dialog);
    desk->dialog.browser->save(desk, path);
}

/// Puts the usual ending to a name that has none.
static void end_name(const browser_state *b, char path[2 * PATH_TEXT]) {
    const char *ending = kinds[b->kind].endings[0];
    if (ending && !strchr(files_base(path), '.')) strcat(path, ending);
}

/// The file is there: the dialog is still open below the question.
static void take_replace(desk_state *desk, int answer) {
    char path[2 * PATH_TEXT];
    const browser_state *b = desk->dialog.browser;
    if (answer != 0) return;
    resolve_path(b, b->path.text, path);
    end_name(b, path);
    save_now(desk, path);
}

static bool has_right_ending(const browser_state *b, const char *path) {
    const char *dot = strrchr(files_base(path), '.');
    const struct kind_row *kind = &kinds[b->kind];
    bool right = !kind->endings[0];
    for (int i = 0; i < 3 && kind->endings[i]; i++)
        right |= dot && strcasecmp(dot, kind->endings[i]) == 0;
    return right;
}

static void save_as(desk_state *desk, browser_state *b, char path[2 * PATH_TEXT]) {
    static const char *const answers[] = {"R:Replace", "C:Cancel"};
    char text[2 * PATH_TEXT];
    if (!*files_base(path)) {
        snprintf(b->problem, sizeof b->problem, "A name is needed.");
        return;
    }
    if (strlen(path) + 8 > PATH_TEXT) return;
    end_name(b, path);
    if (!has_right_ending(b, path)) {
        snprintf(b->problem, sizeof b->problem, "%s", kinds[b->kind].wrong);
        return;
    }
    if (!is_there(path)) {
        save_now(desk, path);
        return;
    }
    snprintf(text, sizeof text, "%s is there already.", path);
    question_ask(desk, "Replace the file?", text, answers, 2, take_replace);
}

static void open_file(desk_state *desk, browser_state *b, const char *path, bool ask) {
    if (!is_there(path)) {
        snprintf(b->problem, sizeof b->problem, "There is no such file: %.200s", files_base(path));
        return;
    }
    char copy[2 * PATH_TEXT];
    snprintf(copy, sizeof copy, "%s", path);
    dialog_pop(&desk->dialog);
    b->open(desk, copy, ask);
}

/// What the field names; a beginning of a name stands for the entry that the list has chosen.
static void go_to_path(desk_state *desk, browser_state *b, bool ask) {
    char path[2 * PATH_TEXT];
    resolve_path(b, b->path.text, path);
    if (!b->saves && b->list.at < b->files.entries.count && !is_there(path))
        snprintf(path, sizeof path, "%s", b->files.entries.items[b->list.at].path);
    if (is_folder(path))
        enter_folder(desk, b, path);
    else if (b->saves)
        save_as(desk, b, path);
    else
        open_file(desk, b, path, ask);
}

static void go_to_place(desk_state *desk, browser_state *b, browser_place place) {
    b->place = place;
    b->sort = SORT_NAME;
    b->down = false;
    if (!b->saves) set_path(b, b->folder, "");
    refill_list(desk, b);
}

static void sort_by(desk_state *desk, browser_state *b, folder_sort sort) {
    b->down = b->sort == sort ? !b->down : sort != SORT_NAME; // largest and newest first
    b->sort = sort;
    refill_list(desk, b);
}

static void go_up(desk_state *desk, browser_state *b) {
    char parent[PATH_TEXT];
    snprintf(parent, sizeof parent, "%.*s", PATH_TEXT - 1, b->folder);
    char *slash = strrchr(parent, '/');
    if (slash) slash[slash == parent] = '\0';
    enter_folder(desk, b, b->place == PLACE_FOLDER ? parent : b->folder);
}

void browser_act(desk_state *desk, int id) {
    browser_state *b = desk->dialog.browser;
    switch (id) {
    case DIALOG_CANCEL:
        desk->file.pending = PENDING_NONE;
        dialog_pop(&desk->dialog);
        break;
    case DIALOG_MAIN:
    case LIST:
        go_to_path(desk, b, false);
        break;
    case OPTIONS:
        go_to_path(desk, b, true);
        break;
    case RECENT:
        go_to_place(desk, b, PLACE_RECENT);
        break;
    case SAMPLES:
        go_to_place(desk, b, PLACE_SAMPLES);
        break;
    case HOME:
        if (getenv("HOME")) enter_folder(desk, b, getenv("HOME"));
        break;
    case PARENT:
        go_up(desk, b);
        break;
    case ALL_FILES:
        b->all = !b->all;
        refill_list(desk, b);
        break;
    default:
        if (id >= HEAD_NAME && id <= HEAD_CHANGED) sort_by(desk, b, (folder_sort)(id - HEAD_NAME));
        break;
    }
}

static browser_state *show_browser(desk_state *desk, bool saves, browse_kind kind) {
    browser_state *b = state_of(desk);
    if (!b) return NULL;
    b->saves = saves;
    b->kind = kind;
    const char *path = desk->document->source.path;
    char folder[PATH_TEXT] = ".";
    const char *slash = path ? strrchr(path, '/') : NULL;
    if (slash)
        snprintf(folder, sizeof folder, "%.*s", slash == path ? 1 : (int)(slash - path), path);
    if (b->folder[0]) snprintf(folder, sizeof folder, "%s", b->folder);
    field_set(&b->path, "");
    enter_folder(desk, b, folder);
    dialog_push(&desk->dialog, DIALOG_BROWSER, PATH_FIELD);
    return b;
}

void browser_open(desk_state *desk, browse_kind kind, browser_open_file *then) {
    browser_state *b = show_browser(desk, false, kind);
    sl_map_list recent = {0};
    if (!b) return;
    b->open = then;
    if (kind != BROWSE_MAPS) return;
    // At first there is no folder of the user's: what he had last, or the samples.
    const bool any = recent_list(desk->context, &recent) == SL_OK && recent.count;
    if (!desk->document->source.path && !desk->ui->steady)
        go_to_place(desk, b, any ? PLACE_RECENT : PLACE_SAMPLES);
    sl_map_list_destroy(desk->context, &recent);
}

/// Puts a name into the field that no file of the folder has: "plan.png", then "plan-2.png".
static void set_free_path(browser_state *b, const char *name) {
    const char *dot = strrchr(name, '.');
    const int stem = (int)(dot ? dot - name : (ptrdiff_t)strlen(name));
    char other[280];
    set_path(b, b->folder, name);
    for (int i = 2; i < 10000 && is_there(b->path.text); i++) {
        snprintf(other, sizeof other, "%.*s-%d%s", stem, name, i, name + stem);
        set_path(b, b->folder, other);
    }
}

void browser_save(desk_state *desk, browse_kind kind, const char *name, browser_save_file *then) {
    browser_state *b = show_browser(desk, true, kind);
    if (!b) return;
    b->save = then;
    if (access(b->folder, W_OK) != 0) enter_folder(desk, b, getenv("HOME") ? getenv("HOME") : ".");
    if (kind >= BROWSE_PICTURES)
        set_free_path(b, name);
    else
        set_path(b, b->folder, name);
    b->path.chosen = true; // what is typed replaces the suggestion
}

void browser_save_to(desk_state *desk, const char *path, browser_save_file *then) {
    browser_state *b = show_browser(desk, true, BROWSE_MAPS);
    if (!b) return;
    b->save = then;
    field_set(&b->path, path);
    follow_field(desk, b);
}

// --- the picture

static void write_size(double bytes, char text[32]) {
    static const char *const units[] = {"B", "kB", "MB", "GB", "TB"};
    int unit = 0;
    while (bytes >= 1000 && unit < 4) {
        bytes /= 1000;
        unit++;
    }
    snprintf(text, 32, bytes < 10 && unit ? "%.1f %s" : "%.0f %s", bytes, units[unit]);
}

static void draw_entry(ui_state *ui, sl_box row, const folder_entry *entry) {
    const double t = ui->text, base = row.min.y + 1.2 * t;
    char text[320], when[32] = "";
    struct tm local;
    const time_t changed = (time_t)entry->changed;
    snprintf(text, sizeof text, "%.300s%s", entry->name, entry->folder ? "/" : "");
    sl_text_show_within(ui->cairo, entry->folder ? ui->palette.glass : ui->palette.ink,
                        row.min.x + 0.5 * t, base, box_width(row) - 19 * t, t, entry->folder, text);
    if (!entry->folder) {
        write_size(entry->size, text);
        ui_text_right(ui, row.max.x - 11 * t, base, 0.95, ui->palette.faint, text);
    }
    if (localtime_r(&changed, &local)) strftime(when, sizeof when, "%Y-%m-%d %H:%M", &local);
    ui_text_right(ui, row.max.x - 0.6 * t, base, 0.95, ui->palette.faint, when);
}

static void draw_list(desk_state *desk, browser_state *b, sl_box box) {
    ui_state *ui = desk->ui;
    const double t = ui->text;
    static const char *const heads[] = {"Name", "Size", "Changed"};
    const double ends[] = {box_width(box) - 17.5 * t, box_width(box) - 11 * t, box_width(box)};
    double left = box.min.x;
    for (int i = 0; i < 3; i++) {
        char text[32];
        snprintf(text, sizeof text, "%s%s", heads[i],
                 (int)b->sort != i ? ""
                 : b->down         ? " \xe2\x96\xbe"
                                   : " \xe2\x96\xb4");
        const sl_box head = {{left, box.min.y}, {box.min.x + ends[i], box.min.y + 1.5 * t}};
        dialog_head(&desk->dialog, HEAD_NAME + i, head, text);
        left = head.max.x;
    }
    const sl_box frame = {{box.min.x, box.min.y + 1.5 * t}, box.max};
    dialog_list_frame(&desk->dialog, LIST, frame, &b->list);
    if (!b->list.count)
        ui_text(ui, frame.min.x + 0.6 * t, frame.min.y + 1.4 * t, 1, false, ui->palette.faint,
                b->place == PLACE_RECENT    ? "No file was opened yet."
                : b->place == PLACE_SAMPLES ? "The samples are not installed."
                : b->all                    ? "The folder is empty."
                                            : kinds[b->kind].none);
    for (size_t i = b->list.first; i < b->list.count && i < b->list.first + b->list.page; i++)
        draw_entry(desk->ui, dialog_list_row(&desk->dialog, LIST, frame, &b->list, i),
                   &b->files.entries.items[i]);
}

void browser_draw(desk_state *desk) {
    static const dialog_label places[] = {
        {RECENT, "Recent files"}, {SAMPLES, "Samples"}, {HOME, "Home"}, {PARENT, "Folder above"}};
    ui_state *ui = desk->ui;
    browser_state *b = desk->dialog.browser;
    // With large text the sheet has fewer rows, and text stays large.
    const double wide = fmin(fmax((ui->width - 12) / ui->text, 44), 58);
    const double text = fmin(ui->text, (ui->width - 12) / wide);
    const double high = fmin(fmax((ui->height - 12) / text, 24), 40);
    const sl_box box = dialog_begin(&desk->dialog, wide, high,
                                    b->saves ? kinds[b->kind].save : kinds[b->kind].open);
    const double t = ui->text, x0 = box.min.x, x1 = box.max.x;
    const dialog_label ends[] = {{OPTIONS, "Options..."},
                                 {DIALOG_CANCEL, "Cancel"},
                                 {DIALOG_MAIN, b->saves ? "Save" : "Open"}};
    double y = box.min.y;
    dialog_field(&desk->dialog, PATH_FIELD, (sl_box){{x0, y}, {x1, y + 1.9 * t}}, &b->path,
                 "A path; Tab completes it");
    y += 2.6 * t;
    const int skip = b->kind == BROWSE_MAPS ? 0 : 2; // recent files and samples are maps
    dialog_buttons(&desk->dialog, x0 + dialog_buttons_width(&desk->dialog, places + skip, 4 - skip),
                   y, places + skip, 4 - skip);
    y += 2.3 * t;
    draw_list(desk, b, (sl_box){{x0, y}, {x1, box.max.y - 4.2 * t}});
    y = box.max.y - 1.8 * t;
    const char *note = b->place == PLACE_RECENT    ? "The files that were opened last"
                       : b->place == PLACE_SAMPLES ? "The maps that come with Sightline"
                                                   : "Ctrl+Up: the folder above";
    if (b->problem[0])
        dialog_problem(&desk->dialog, (sl_point){x0, y - 0.9 * t}, x1 - x0, b->problem);
    else
        ui_text(ui, x0, y - 0.9 * t, 1, false, ui->palette.faint, note);
    const int from = b->saves || b->kind != BROWSE_MAPS ? 1 : 0;
    const double left = dialog_buttons(&desk->dialog, x1, y, ends + from, 3 - from);
    if (b->place == PLACE_FOLDER)
        dialog_check(&desk->dialog, ALL_FILES,
                     (sl_box){{x0, y}, {fmin(x0 + 22 * t, left - t), y + 1.8 * t}}, "All files",
                     b->all);
    dialog_end(&desk->dialog);
}
