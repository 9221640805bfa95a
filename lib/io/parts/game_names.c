/// What names say in the files of games: lists of words.
#include "io/parts/game_names.h"

#include <strings.h>

#define IS_ONE_OF(word, list) sli_word_in(word, list, sizeof(list) / sizeof *(list))

static const char *const drawn_words[] = {
    "above",      "over",   "overhead", "overlay",     "roof",        "rooftop",  "ceiling",
    "top",        "deco",   "decor",    "decoration",  "decorative",  "decal",    "detail",
    "shadow",     "light",  "lighting", "lamp",        "foreground",  "fg",       "fringe",
    "background", "bg",     "sky",      "parallax",    "cloud",       "canopy",   "upper",
    "effect",     "fx",     "ambient",  "weather",     "fog",         "particle", "hint",
    "text",       "label",  "ui",       "minimap",     "preview",     "paper",    "behind",
    "backdrop",   "front",  "glow",     "torch",       "window",      "poster",   "sign",
    "painting",   "carpet", "rug",      "flower",      "outline",     "face",     "dach",
    "toit",       "techo",  "tetto",    "ombre",       "sombra",      "schatten", "deko",
    "dekoration", "fondo",  "fond",     "hintergrund", "vordergrund", "облака",   "тени",
    "крыша",      "屋顶",   "阴影",     "装饰",
};
static const char *const floor_words[] = {
    "floor", "path", "room",      "corridor", "hallway", "flooring", "boden", "sol",
    "suelo", "piso", "pavimento", "golv",     "podłoga", "пол",      "地板",  "床",
};
static const char *const ground_words[] = {
    "ground",   "grass",    "sand",   "dirt",   "mud",      "snow",   "ice",    "road",
    "field",    "desert",   "beach",  "meadow", "gravel",   "soil",   "earth",  "street",
    "sidewalk", "pavement", "plank",  "farm",   "farmland", "moss",   "leaf",   "bush",
    "hay",      "crop",     "wiese",  "gras",   "herbe",    "herbes", "hierba", "erba",
    "straße",   "weg",      "chemin", "camino", "地面",     "草地",
};
static const char *const pass_words[] = {
    "bridge", "ladder", "stair",    "step",      "door",       "gate",     "air",
    "empty",  "open",   "walkable", "passable",  "void",       "none",     "nothing",
    "rope",   "vine",   "climb",    "climbable", "leiter",     "escalera", "scala",
    "spawn",  "start",  "exit",     "zone",      "trigger",    "coin",     "item",
    "player", "enemy",  "emitter",  "trail",     "checkpoint", "finish",
};
/// What stands about and is no wall, unless a word for solid is beside it.
static const char *const open_words[] = {
    "flora", "foliage", "plant",  "vegetation", "chain",
    "spike", "thorn",   "hazard", "route",      "waypoint",
};
static const char *const water_words[] = {
    "water",  "lava",  "pit",     "river",    "lake",     "sea",     "ocean",
    "pond",   "acid",  "hole",    "chasm",    "abyss",    "liquid",  "swamp",
    "magma",  "fence", "railing", "barriere", "barrière", "clôture", "zaun",
    "wasser", "eau",   "agua",    "água",     "acqua",    "вода",    "水",
};
static const char *const stands_words[] = {
    "tree",   "building", "house",  "rock",     "cliff",   "mountain",  "boulder", "hedge",
    "pillar", "column",   "tower",  "ruin",     "forest",  "structure", "stone",   "brick",
    "bäume",  "haus",     "häuser", "gebäude",  "arbre",   "maison",    "árbol",   "árboles",
    "casa",   "edificio", "albero", "alberi",   "дома",    "деревья",   "树",      "房子",
    "建筑",   "wood",     "metal",  "concrete", "granite", "bedrock",
};
static const char *const likely_words[] = {
    "meta",  "platform",    "plattform", "plateforme", "plateform", "plataforma",
    "world", "piattaforma", "physics",   "hitbox",     "wand",      "border",
};
/// Beside words for solid: which walls they are.
static const char *const which_words[] = {
    "inner",       "outer", "inside",  "outside", "interior", "exterior", "indoor",     "outdoor",
    "house",       "room",  "dungeon", "castle",  "cave",     "building", "city",       "town",
    "world",       "level", "game",    "main",    "static",   "player",   "physics",    "invisible",
    "hidden",      "stone", "brick",   "wood",    "wooden",   "rock",     "north",      "south",
    "east",        "west",  "left",    "right",   "bottom",   "lower",    "low",        "big",
    "small",       "high",  "tall",    "thick",   "thin",     "all",      "first",      "second",
    "my",          "the",   "and",     "a",       "b",        "c",        "x",          "y",
    "line",        "full",  "data",    "check",   "info",     "grid",     "set",        "tileset",
    "metal",       "iron",  "steel",   "marble",  "basic",    "tilemap",  "tileslayer", "env",
    "environment", "hard",  "physic",
};
/// Words for solid that say what stops a player, not what it looks like.
static const char *const stop_words[] = {
    "collide",  "collides", "collider", "collidable", "collideable", "obstacle",   "blocked",
    "blocking", "blocker",  "solid",    "impassable", "impassible",  "unwalkable", "unpassable",
    "nowalk",   "colisión", "colisao",  "colisão",    "hindernis",
};
/// Before a word for solid: it is none.
static const char *const without_words[] = {
    "no",    "non",      "not",         "un",        "without",      "ohne",        "sans", "sin",
    "senza", "nonsolid", "nocollision", "nocollide", "nocollisions", "passthrough", "без",
};
static const char *const inside_words[] = {
    "sewer",     "dungeon", "cave",   "cavern", "crypt",     "catacomb", "mine",        "tomb",
    "roguelike", "rogue",   "cellar", "prison", "labyrinth", "maze",     "underground",
};
static const char *const other_words[] = {
    "enemy",    "enemies", "npc",         "monster",     "mob",        "goblin",   "orc",
    "skeleton", "zombie",  "slime",       "bat",         "rat",        "spider",   "boss",
    "guard",    "item",    "coin",        "potion",      "trigger",    "event",    "spawner",
    "pickup",   "loot",    "trap",        "animal",      "villager",   "merchant", "trader",
    "bullet",   "powerup", "collectible", "collectable", "gem",        "creature", "critter",
    "ghost",    "warp",    "teleport",    "teleporter",  "transition", "dialog",   "dialogue",
    "sound",    "music",   "foe",         "hostile",     "minion",     "weapon",   "ammo",
    "health",   "bandit",  "wolf",        "dragon",      "troll",      "soldier",  "dialogo",
    "diálogo",  "finish",  "checkpoint",  "waypoint",    "route",      "goomba",   "koopa",
    "turtle"};
/// Others that may well stand in the way.
static const char *const placed_words[] = {"chest",  "key",   "crate",  "shop",   "sign",
                                           "camera", "light", "turret", "switch", "button"};

/// Which kinds the words of a name are of.
typedef struct kinds {
    bool without, solid, drawn, floor, ground, pass, open, water, stands, likely, unknown;
} kinds;

static kinds kinds_of(const char *name) {
    kinds all = {.solid = false};
    bool back = false;
    for (sli_name_word word; sli_word_next(&name, &word);) {
        const bool solid = sli_says_solid(word.text), which = IS_ONE_OF(&word, which_words);
        all.solid |= solid;
        all.without |= IS_ONE_OF(&word, without_words);
        // backGround is two words.
        const bool picture = back && strcmp(word.text, "ground") == 0;
        back = strcmp(word.text, "back") == 0 || strcmp(word.text, "fore") == 0;
        all.drawn |= picture || IS_ONE_OF(&word, drawn_words);
        all.floor |= IS_ONE_OF(&word, floor_words);
        all.ground |= IS_ONE_OF(&word, ground_words);
        all.pass |= IS_ONE_OF(&word, pass_words);
        all.open |= IS_ONE_OF(&word, open_words);
        all.water |= IS_ONE_OF(&word, water_words);
        all.stands |= IS_ONE_OF(&word, stands_words);
        all.likely |= IS_ONE_OF(&word, likely_words);
        all.unknown |= !solid && !which && strcmp(word.text, "layer") != 0 &&
                       strcmp(word.text, "tile") != 0 && strcmp(word.text, "tiles") != 0;
    }
    return all;
}

sli_game_kind sli_game_kind_of(const char *name) {
    if (sli_says_solid(name)) return SLI_GAME_SOLID;
    if (sli_says_walkable(name)) return SLI_GAME_PASS;
    const kinds all = kinds_of(name);
    if (all.without) return SLI_GAME_PASS;
    if (all.drawn) return SLI_GAME_DRAWN;
    if (all.solid) return all.unknown ? SLI_GAME_LIKELY : SLI_GAME_SOLID;
    if (all.pass) return SLI_GAME_PASS;
    if (all.water) return SLI_GAME_WATER;
    if (all.likely) return SLI_GAME_LIKELY;
    if (all.open) return SLI_GAME_PASS;
    if (all.floor) return SLI_GAME_FLOOR;
    if (all.ground) return SLI_GAME_GROUND;
    return all.stands ? SLI_GAME_STANDS : SLI_GAME_UNSAID;
}

bool sli_game_says_stops(const char *name) {
    const kinds all = kinds_of(name);
    if (all.without || all.drawn || all.pass || sli_says_walkable(name)) return false;
    if (sli_game_says_other(name)) return false;
    for (sli_name_word word; sli_word_next(&name, &word);)
        if (IS_ONE_OF(&word, stop_words) || sli_word_is_collision(&word)) return true;
    return false;
}

bool sli_game_says_beside_player(const char *name) {
    static const char *const sides[] = {"below", "above", "under", "over", "beneath", "behind"};
    static const char *const players[] = {"player", "players", "hero", "character", "char"};
    static const char *const both[] = {"belowplayer", "aboveplayer", "underplayer", "overplayer",
                                       "behindplayer"};
    bool side = false, player = false;
    for (sli_name_word word; sli_word_next(&name, &word);) {
        side |= IS_ONE_OF(&word, sides) || IS_ONE_OF(&word, both);
        player |= IS_ONE_OF(&word, players) || IS_ONE_OF(&word, both);
    }
    return side && player;
}

bool sli_game_says_inside(const char *name) {
    for (sli_name_word word; sli_word_next(&name, &word);)
        if (IS_ONE_OF(&word, inside_words)) return true;
    return false;
}

bool sli_game_says_other(const char *name) {
    for (sli_name_word word; sli_word_next(&name, &word);)
        if (IS_ONE_OF(&word, other_words) || IS_ONE_OF(&word, placed_words)) return true;
    return false;
}

bool sli_game_says_passing(const char *name) {
    for (sli_name_word word; sli_word_next(&name, &word);)
        if (IS_ONE_OF(&word, other_words)) return true;
    return false;
}

bool sli_game_says_furniture(const char *name) {
    static const char *const words[] = {"icon",      "interaction", "interactive",
                                        "interface", "hud",         "gui"};
    if (strncasecmp(name, "object", 6) == 0 || strncasecmp(name, "sprite", 6) == 0 ||
        strncasecmp(name, "entit", 5) == 0)
        return true;
    for (sli_name_word word; sli_word_next(&name, &word);)
        if (IS_ONE_OF(&word, words)) return true;
    return false;
}

bool sli_game_truth(const char *text, bool *truth) {
    static const char *const yes[] = {"true", "yes", "y",     "on",    "1",       "x",
                                      "full", "all", "solid", "block", "blocked", "wall"};
    static const char *const no[] = {"false", "no", "n", "off", "0", "none", "", "open", "never"};
    for (size_t i = 0; i < sizeof yes / sizeof *yes; i++)
        if (strcasecmp(text, yes[i]) == 0) return *truth = true;
    *truth = false;
    for (size_t i = 0; i < sizeof no / sizeof *no; i++)
        if (strcasecmp(text, no[i]) == 0) return true;
    return false;
}
