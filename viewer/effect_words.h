/// What a map calls for beside walls, in words.
#ifndef VIEWER_EFFECT_WORDS_H
#define VIEWER_EFFECT_WORDS_H

#include "sightline/effects.h"

enum { CALLS_TEXT = 160 };

/// "calls for doors (6), mirrors (2)"; where nothing does, that.
void effects_in_words(const sl_map *map, char text[CALLS_TEXT]);

/// The effects that nothing in the map calls for: "mirrors, a view range"; empty where there are
/// none.
void effects_left_out(const sl_map *map, char text[CALLS_TEXT]);

#endif
