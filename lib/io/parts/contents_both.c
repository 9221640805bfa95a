/// Layers whose names say walls, and windows or doors as well ("walls, windows"). Such a layer has
/// the walls where its lines are longer than all that is named for walls alone, as columns may be.
/// Else it has the windows or doors of the walls beside it.
#include "io/parts/choice.h"

#include "geometry/length.h"

static double length_of(const sli_choice *c, const sli_group_run *run) {
    double length = 0;
    for (size_t i = run->first; i < run->end; i++) {
        const sl_wall *wall = &c->map->walls[i];
        length += sli_length(wall->b.x - wall->a.x, wall->b.y - wall->a.y);
    }
    return length;
}

void sli_choice_take_both(const sli_choice *c) {
    double walls = 0, both = 0;
    for (size_t i = 0; i < c->contents->runs.count; i++) {
        const sli_group_run *run = &c->contents->runs.items[i];
        const sli_group *group = &c->contents->groups.items[run->group];
        if (group->beside) both += length_of(c, run);
        if (group->guess == SLI_MEANS_WALL) walls += length_of(c, run);
    }
    for (size_t i = 0; both > walls && i < c->contents->groups.count; i++) {
        sli_group *group = &c->contents->groups.items[i];
        if (!group->beside) continue;
        group->guess = SLI_MEANS_WALL;
        if (!group->said) group->means = SLI_MEANS_WALL;
    }
}

void sli_choice_note_both(const sli_choice *c) {
    const bool said = sli_contents_said(c->contents);
    for (size_t i = 0; !said && i < c->contents->groups.count; i++) {
        const sli_group *group = &c->contents->groups.items[i];
        const bool walls = group->means == SLI_MEANS_WALL;
        if (!group->beside || group->said || !group->walls) continue;
        const char *beside = sli_meaning_text(group->beside), *name = group->name;
        const bool plain = group->length <= 80 && !strpbrk(name, "',");
        sl_note(c->contents->context,
                "%s: %.80s: named for walls and for %ss: taken for %ss, as its lines are %s than "
                "those of layers named for walls alone; --layers '%.80s=%s' takes it for %ss",
                c->contents->file, name, beside, walls ? "wall" : beside,
                walls ? "longer" : "shorter", plain ? name : "NAME", walls ? beside : "wall",
                walls ? beside : "wall");
    }
}
