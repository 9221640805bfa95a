/// What is kept between runs in $XDG_CONFIG_HOME/sightline, such as the files opened last (recent);
/// and what a file is.
#include "document/files.h"

#include "sightline/import.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

const char *files_base(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

bool files_end_in(const char *path, const char *ending) {
    const size_t length = strlen(path), more = strlen(ending);
    return length > more && strcasecmp(path + length - more, ending) == 0;
}

bool files_savable(const char *path) {
    return files_end_in(path, ".map") || files_end_in(path, ".slv");
}

sl_status files_set_text(sl_context *context, char **to, const char *text) {
    char *copy = text ? sl_copy_text(context, text, strlen(text)) : NULL;
    if (text && !copy) return SL_NO_MEMORY;
    sl_free(context, *to);
    *to = copy;
    return SL_OK;
}

bool files_folder(const char *variable, const char *beside_home, char path[PATH_TEXT], bool make) {
    const char *given = getenv(variable), *home = getenv("HOME");
    char folder[PATH_TEXT - 64];
    int length;
    if (given && given[0] == '/')
        length = snprintf(folder, sizeof folder, "%s", given);
    else if (home && home[0] == '/')
        length = snprintf(folder, sizeof folder, "%s/%s", home, beside_home);
    else
        return false;
    if (length < 0 || (size_t)length >= sizeof folder) return false;
    // Folders on the way are made too: a fresh account has no ~/.local.
    for (char *at = folder + 1; make && (at = strchr(at, '/')) != NULL; at++) {
        *at = '\0';
        mkdir(folder, 0700);
        *at = '/';
    }
    if (make) mkdir(folder, 0700);
    snprintf(path, PATH_TEXT, "%s/sightline", folder);
    if (make) mkdir(path, 0700);
    return true;
}

bool files_kept(const char *name, char path[PATH_TEXT], bool make) {
    if (!files_folder("XDG_CONFIG_HOME", ".config", path, make)) return false;
    const size_t length = strlen(path);
    snprintf(path + length, PATH_TEXT - length, "/%s", name);
    return true;
}

// --- recent files

enum { RECENT_MOST = 12 };

sl_status recent_list(sl_context *context, sl_map_list *list) {
    char path[PATH_TEXT];
    sl_bytes bytes;
    if (!files_kept("recent", path, false) || sl_file_read(context, path, &bytes) != SL_OK)
        return SL_OK;
    sl_status status = SL_OK;
    for (char *line = bytes.data, *next; line && *line && status == SL_OK; line = next) {
        next = strchr(line, '\n');
        if (next) *next++ = '\0';
        if (*line == '/' && list->count < RECENT_MOST)
            status = sl_map_list_add(context, list, line, strlen(line));
    }
    sl_free(context, bytes.data);
    return status;
}

void recent_add(sl_context *context, const char *name) {
    char path[PATH_TEXT];
    char *full = realpath(name, NULL);
    sl_map_list before = {0};
    sl_output output;
    if (full && !strchr(full, '\n') && files_kept("recent", path, true) &&
        recent_list(context, &before) == SL_OK && sl_output_open(context, path, &output) == SL_OK) {
        fprintf(output.stream, "%s\n", full);
        size_t kept = 1;
        for (size_t i = 0; i < before.count && kept < RECENT_MOST; i++) {
            if (strcmp(before.names[i], full) == 0) continue;
            fprintf(output.stream, "%s\n", before.names[i]);
            kept++;
        }
        sl_output_close(context, &output, SL_OK);
    }
    sl_map_list_destroy(context, &before);
    free(full);
}

// --- what a file is

sl_status files_look(sl_context *context, document_source *source, sl_map_choice *choice) {
    if (document_is_baked(source->path)) return SL_OK;
    SL_TRY(sl_map_choice_read(context, source->path, choice));
    source->takes = choice->format->takes;
    source->lowest = choice->lowest;
    source->highest = choice->highest;
    if (source->highest > source->lowest && !source->options.has_slice) {
        source->options.has_slice = true;
        source->options.slice = source->lowest + (source->highest - source->lowest) / 2;
    }
    return SL_OK;
}
