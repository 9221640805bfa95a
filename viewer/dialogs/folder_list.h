/// What a folder holds, as the file browser lists it; and the samples that come with the program.
#ifndef VIEWER_FOLDER_LIST_H
#define VIEWER_FOLDER_LIST_H

#include "sightline/support.h"

typedef struct folder_entry {
    char *name; ///< as shown; of a sample with its folder
    char *path;
    bool folder;
    double size; ///< bytes
    int64_t changed;
} folder_entry;

/// Zeroed, it is empty.
typedef struct folder_list {
    SL_ARRAY(folder_entry) entries;
} folder_list;

typedef enum folder_sort { SORT_NAME, SORT_SIZE, SORT_CHANGED } folder_sort;

/// Which files are listed. Folders always are.
typedef enum folder_filter {
    FILTER_READABLE, ///< those that Sightline reads: by their ending, doubtful ones by their bytes
    FILTER_SAVED,    ///< .map and .slv
    FILTER_TABLES,   ///< .csv and .txt
    FILTER_PICTURES, ///< .png, .svg and .pdf
    FILTER_ALL,
} folder_filter;

void folder_list_clear(sl_context *context, folder_list *list);

/// Lists a folder anew. SL_IO where it cannot be read; the list is empty then.
sl_status folder_list_read(sl_context *context, folder_list *list, const char *folder,
                           folder_filter filter);

bool is_folder(const char *path);

/// Adds one file, under a name; nothing where it is not there.
sl_status folder_list_add(sl_context *context, folder_list *list, const char *path,
                          const char *name);

/// Adds all maps in a folder and in those in it, named from there.
sl_status folder_list_add_all(sl_context *context, folder_list *list, const char *folder);

/// Folders come first in any order.
void folder_list_sort(folder_list *list, folder_sort by, bool down);

/// The folder of the samples: that of the installed program, else that of the project it was built
/// from. False where neither is there.
bool folder_of_samples(char *path, size_t room);

#endif
