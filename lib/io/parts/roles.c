/// Roles of layers, as a user says them.
#include "io/parts/roles.h"

#include <strings.h>

static const struct {
    const char *name;
    sli_meaning means;
} roles[] = {{"wall", SLI_MEANS_WALL},
             {"door", SLI_MEANS_DOOR},
             {"window", SLI_MEANS_WINDOW},
             {"furniture", SLI_MEANS_LOW},
             {"ignore", SLI_MEANS_OTHER}};

enum { ROLES = sizeof roles / sizeof *roles };

/// Cuts the role off the end of a word; ROLES where it has none.
static size_t cut_role(sli_word *word) {
    for (size_t i = 0; i < ROLES; i++) {
        const size_t length = strlen(roles[i].name) + 1;
        if (word->length <= length) continue;
        const char *at = word->at + word->length - length;
        if (*at != '=' || strncasecmp(at + 1, roles[i].name, length - 1) != 0) continue;
        word->length -= length;
        return i;
    }
    return ROLES;
}

bool sli_roles_are(const char *list) {
    for (sli_word word; list && sli_layers_next(&list, &word);)
        if (cut_role(&word) < ROLES) return true;
    return false;
}

bool sli_roles_next(const char **list, sli_word *name, sli_meaning *means) {
    if (!sli_layers_next(list, name)) return false;
    const size_t role = cut_role(name);
    *means = role < ROLES ? roles[role].means : SLI_MEANS_WALL;
    return true;
}

bool sli_roles_find(const char *list, sli_word name, sli_meaning *means) {
    sli_meaning each;
    bool found = false;
    for (sli_word word; list && sli_roles_next(&list, &word, &each);) {
        if (word.length != name.length || strncasecmp(word.at, name.at, name.length) != 0) continue;
        *means = each;
        found = true;
    }
    return found;
}

const char *sli_role_name(sli_meaning means) {
    for (size_t i = 0; i < ROLES; i++)
        if (roles[i].means == means) return roles[i].name;
    return sli_role_name(SLI_MEANS_OTHER);
}
