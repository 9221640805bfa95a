/// What names say in the files of games, beyond the firm words for what is solid (names.h).
#ifndef SL_GAME_NAMES_H
#define SL_GAME_NAMES_H

#include "io/parts/names.h"

/// What a layer, a terrain or a value of cells is by its name.
typedef enum sli_game_kind {
    SLI_GAME_UNSAID,
    SLI_GAME_DRAWN,  ///< a picture only: above, roof, decoration, shadow, background
    SLI_GAME_FLOOR,  ///< floor, path, room: where it is not, there is a wall
    SLI_GAME_PASS,   ///< ladder, bridge, door, air, exit: open
    SLI_GAME_GROUND, ///< ground, grass, sand: open seen from above, solid in a platformer
    SLI_GAME_WATER,  ///< water, lava, pit: one sees over it, and does not walk on it
    SLI_GAME_STANDS, ///< trees, buildings, cliffs: solid where nothing says more
    SLI_GAME_LIKELY, ///< a word for solid among others, platforms, meta: solid before those
    SLI_GAME_SOLID,  ///< all words are words for solid, or say which: "inner walls"
} sli_game_kind;

sli_game_kind sli_game_kind_of(const char *name);

/// Whether the name says what stops a player, whatever it looks like: some word is one for that
/// (collision, blocked, obstacle), and none for a picture, an enemy, an item or a trigger:
/// "CollisionHorizontal", but not "walls", "light collisions", "enemy collision".
bool sli_game_says_stops(const char *name);

/// Whether the name is of what is drawn below or above the player: "Below Player", "abovePlayer".
bool sli_game_says_beside_player(const char *name);

/// Whether the name is of a dungeon, a cave, a sewer ..., where most of a map is rock.
bool sli_game_says_inside(const char *name);

/// Whether some word is one for an enemy, a person of the game, an item or a trigger: what stands
/// with such a word is neither a start nor a door.
bool sli_game_says_other(const char *name);
/// The same without what may stand in the way, as chests do.
bool sli_game_says_passing(const char *name);

/// Whether the name is of what stands in rooms or walks there, or is shown over them: objects,
/// sprites, icons.
bool sli_game_says_furniture(const char *name);

/// Whether a text is true or false: "yes", "1", "full"; "no", "0", "none" ...
bool sli_game_truth(const char *text, bool *truth);

#endif
