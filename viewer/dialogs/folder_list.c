/// Reads, filters and sorts the files of a folder.
#include "dialogs/folder_list.h"

#include "sightline/import.h"

#include <SDL.h>
#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum { ENTRIES_MOST = 10000, PATH_ROOM = 4096, HEAD = 1 << 20, DEEPEST = 4 };

void folder_list_clear(sl_context *context, folder_list *list) {
    for (size_t i = 0; i < list->entries.count; i++) {
        sl_free(context, list->entries.items[i].name);
        sl_free(context, list->entries.items[i].path);
    }
    sl_free(context, list->entries.items);
    *list = (folder_list){0};
}

// --- what can be read

static bool is_plan(const char *text, size_t size) {
    if (!size) return false;
    for (size_t i = 0; i < size; i++)
        if (!text[i] || !strchr("# .+@\r\n", text[i])) return false;
    return memchr(text, '#', size) != NULL;
}

/// Whether a file whose ending many programs use holds a map. Only its beginning is looked at.
static bool holds_map(const sl_context *context, const char *path, const char *ending,
                      const sl_map_format *formats, size_t count) {
    char *head = malloc(HEAD + 1);
    FILE *file = head ? fopen(path, "rb") : NULL;
    bool found = false;
    (void)context;
    if (file) {
        const size_t size = fread(head, 1, HEAD, file);
        head[size] = '\0';
        fclose(file);
        if (strcasecmp(ending, ".txt") == 0)
            found = is_plan(head, size);
        else if (strcasecmp(ending, ".json") != 0)
            found = strstr(head, "image:") != NULL;
        for (size_t i = 0; i < count && strcasecmp(ending, ".json") == 0; i++)
            found |= strstr(formats[i].endings, ".json") && formats[i].knows &&
                     formats[i].knows(head, size);
    }
    free(head);
    return found;
}

static bool has_ending(const char *endings, const char *ending) {
    for (const char *at = endings; *at;) {
        const size_t length = strcspn(at, " ");
        if (strlen(ending) == length && strncasecmp(ending, at, length) == 0) return true;
        for (at += length; *at == ' ';) at++;
    }
    return false;
}

static bool is_readable(const sl_context *context, const char *path, const char *name) {
    static const char doubtful[] = ".txt .json .yaml .yml";
    const char *dot = strrchr(name, '.');
    size_t count;
    const sl_map_format *formats = sl_map_formats(context, &count);
    if (!dot) return false;
    if (has_ending(".slv .storeys", dot)) return true;
    for (size_t i = 0; i < count; i++)
        if (has_ending(formats[i].endings, dot))
            return !has_ending(doubtful, dot) || holds_map(context, path, dot, formats, count);
    return false;
}

static bool is_listed(const sl_context *context, const char *path, const char *name,
                      folder_filter filter) {
    const char *dot = strrchr(name, '.');
    if (filter == FILTER_ALL) return true;
    if (filter == FILTER_TABLES) return dot && has_ending(".csv .txt", dot);
    if (filter == FILTER_PICTURES) return dot && has_ending(".png .svg .pdf", dot);
    return filter == FILTER_READABLE ? is_readable(context, path, name)
                                     : dot && has_ending(".map .slv", dot);
}

// --- reading

static sl_status add_entry(sl_context *context, folder_list *list, const char *path,
                           const char *name, const struct stat *info) {
    if (list->entries.count >= ENTRIES_MOST) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(context, &list->entries, 1));
    folder_entry entry = {.name = sl_copy_text(context, name, strlen(name)),
                          .path = sl_copy_text(context, path, strlen(path)),
                          .folder = S_ISDIR(info->st_mode),
                          .size = (double)info->st_size,
                          .changed = (int64_t)info->st_mtime};
    if (!entry.name || !entry.path) {
        sl_free(context, entry.name);
        sl_free(context, entry.path);
        return SL_NO_MEMORY;
    }
    list->entries.items[list->entries.count++] = entry;
    return SL_OK;
}

sl_status folder_list_add(sl_context *context, folder_list *list, const char *path,
                          const char *name) {
    struct stat info;
    return stat(path, &info) == 0 ? add_entry(context, list, path, name, &info) : SL_OK;
}

sl_status folder_list_read(sl_context *context, folder_list *list, const char *folder,
                           folder_filter filter) {
    char path[PATH_ROOM];
    folder_list_clear(context, list);
    DIR *dir = opendir(folder);
    if (!dir) return sl_fail(context, SL_IO, "%s: cannot be read", folder);
    sl_status status = SL_OK;
    for (struct dirent *entry; status == SL_OK && (entry = readdir(dir)) != NULL;) {
        struct stat info;
        const int length =
            snprintf(path, sizeof path, "%s/%s", folder[1] ? folder : "", entry->d_name);
        if (entry->d_name[0] == '.' || length >= PATH_ROOM || stat(path, &info) != 0) continue;
        const bool plain = S_ISREG(info.st_mode);
        if (S_ISDIR(info.st_mode) || (plain && is_listed(context, path, entry->d_name, filter)))
            status = add_entry(context, list, path, entry->d_name, &info);
    }
    closedir(dir);
    return status;
}

/// `from`: where the name of an entry begins in its path.
static sl_status add_tree(sl_context *context, folder_list *list, const char *folder, size_t from,
                          int depth) {
    folder_list here = {0};
    sl_status status = folder_list_read(context, &here, folder, FILTER_READABLE);
    for (size_t i = 0; i < here.entries.count && status == SL_OK; i++) {
        const folder_entry *entry = &here.entries.items[i];
        const char *dot = strrchr(entry->name, '.');
        if (entry->folder && depth < DEEPEST)
            status = add_tree(context, list, entry->path, from, depth + 1);
        else if (!entry->folder && dot && has_ending(".map .txt", dot))
            status = folder_list_add(context, list, entry->path, entry->path + from);
    }
    folder_list_clear(context, &here);
    return status;
}

sl_status folder_list_add_all(sl_context *context, folder_list *list, const char *folder) {
    return add_tree(context, list, folder, strlen(folder) + 1, 0);
}

// --- sorting

static int by_name(const void *a, const void *b) {
    const folder_entry *one = a, *other = b;
    if (one->folder != other->folder) return other->folder - one->folder;
    const int order = strcasecmp(one->name, other->name);
    return order ? order : strcmp(one->path, other->path);
}

static int by_size(const void *a, const void *b) {
    const folder_entry *one = a, *other = b;
    if (one->folder || other->folder || one->size == other->size) return by_name(a, b);
    return one->size < other->size ? -1 : 1;
}

static int by_changed(const void *a, const void *b) {
    const folder_entry *one = a, *other = b;
    if (one->folder != other->folder || one->changed == other->changed) return by_name(a, b);
    return one->changed < other->changed ? -1 : 1;
}

static void reverse_order(folder_entry *entries, size_t count) {
    for (size_t i = 0; i < count / 2; i++) {
        const folder_entry swap = entries[i];
        entries[i] = entries[count - 1 - i];
        entries[count - 1 - i] = swap;
    }
}

void folder_list_sort(folder_list *list, folder_sort by, bool down) {
    const size_t count = list->entries.count;
    size_t folders = 0;
    if (!count) return;
    qsort(list->entries.items, count, sizeof *list->entries.items,
          by == SORT_NAME   ? by_name
          : by == SORT_SIZE ? by_size
                            : by_changed);
    while (folders < count && list->entries.items[folders].folder) folders++;
    if (!down) return;
    reverse_order(list->entries.items, folders);
    reverse_order(list->entries.items + folders, count - folders);
}

// --- samples

bool is_folder(const char *path) {
    struct stat info;
    return stat(path, &info) == 0 && S_ISDIR(info.st_mode);
}

bool folder_of_samples(char *path, size_t room) {
    static const char *const folders[] = {SIGHTLINE_SAMPLES, SIGHTLINE_SAMPLES_IN_PLACE};
    char *program = SDL_GetBasePath(); // ends with a slash
    bool found = false;
    for (size_t i = 0; program && i < sizeof folders / sizeof *folders && !found; i++) {
        snprintf(path, room, "%s%s", program, folders[i]);
        found = is_folder(path);
    }
    SDL_free(program);
    return found;
}
