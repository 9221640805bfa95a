/// What the user takes layers of a drawing for, in place of what their names say:
/// "A-GLAZ=window,FURN=ignore" as the list of layers. All other layers stay as they are guessed.
#ifndef SL_ROLES_H
#define SL_ROLES_H

#include "io/parts/meaning.h"
#include "io/parts/names.h"

/// Whether a list of layers (NULL: none) is one of roles: some name in it has a "=wall" or another
/// role behind it.
bool sli_roles_are(const char *list);

/// The next name of a list of roles, and what it is taken for; one without a role is a wall. False
/// at the end.
bool sli_roles_next(const char **list, sli_word *name, sli_meaning *means);

/// What a name is taken for; false where the list, which may be NULL, does not have it. Letters and
/// capitals are the same. The last entry of a name counts.
bool sli_roles_find(const char *list, sli_word name, sli_meaning *means);

/// The role of a meaning: "wall", "door", "window", "furniture" (stops steps, and not sight), else
/// "ignore".
const char *sli_role_name(sli_meaning means);

#endif
