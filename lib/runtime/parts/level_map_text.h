/// The map text of files before 2.0, which have doors and starts nowhere else: statements in lines,
/// words between blanks, comments after '#'. SL_RUNTIME_WITHOUT_OLD_FILES leaves this part out.

#ifndef SL_RUNTIME_WITHOUT_OLD_FILES

/// A place in the map text: the rest of a line, or of the text.
typedef struct slrt_text {
    const unsigned char *at, *end;
} slrt_text;

/// Takes the next line off a text; false at its end.
static bool slrt_take_line(slrt_text *text, slrt_text *line) {
    if (text->at == text->end) return false;
    line->at = line->end = text->at;
    while (line->end < text->end && *line->end != '\n') line->end++;
    text->at = line->end < text->end ? line->end + 1 : line->end;
    if (line->end > line->at && line->end[-1] == '\r') line->end--;
    return true;
}

/// Takes the next word off a line; it is empty at the line's end.
static slrt_text slrt_take_word(slrt_text *line) {
    slrt_text word;
    while (line->at < line->end && (*line->at == ' ' || *line->at == '\t')) line->at++;
    word.at = word.end = line->at;
    while (word.end < line->end && *word.end != ' ' && *word.end != '\t' && *word.end != '#')
        word.end++;
    line->at = word.end < line->end && *word.end == '#' ? line->end : word.end;
    return word;
}

static bool slrt_word_is(const slrt_text *word, const char *text) {
    const unsigned char *at = word->at;
    for (; at < word->end && *text && *at == (unsigned char)*text; at++) text++;
    return at == word->end && !*text;
}

/// What follows the first word of the `number`-th statement with this word, which exists.
static slrt_text slrt_find_statement(const sl_runtime *rt, const char *first, uint32_t number) {
    slrt_text text, line;
    text.at = line.at = line.end = rt->text;
    text.end = rt->text + rt->text_bytes;
    while (slrt_take_line(&text, &line)) {
        const slrt_text word = slrt_take_word(&line);
        if (slrt_word_is(&word, first) && !number--) break;
    }
    return line;
}

/// A decimal: digits, of which the last `fraction` are behind the point, and a power of ten.
typedef struct slrt_decimal {
    slrt_text digits; ///< among them the point
    uint32_t digit_count, fraction;
    int32_t exponent;
    bool negative;
} slrt_decimal;

/// Reads digits, which may have a point among them. Returns how many there are.
static uint32_t slrt_take_digits(slrt_text *word, uint32_t *fraction) {
    uint32_t count = 0;
    bool point = false;
    *fraction = 0;
    for (; word->at < word->end; word->at++) {
        if (*word->at == '.' && !point) {
            point = true;
            continue;
        }
        if (*word->at < '0' || *word->at > '9') break;
        count++;
        if (point) ++*fraction;
    }
    return count;
}

/// Splits a word into the parts of a decimal; false if it is none, or has 512 characters or
/// more, as no file has that `sightline bake` writes.
static bool slrt_parse_decimal(slrt_text word, slrt_decimal *out) {
    int32_t exponent = 0;
    bool down = false;
    memset(out, 0, sizeof *out);
    if (word.end - word.at >= 512) return false;
    if (word.at < word.end && (*word.at == '-' || *word.at == '+'))
        out->negative = *word.at++ == '-';
    out->digits.at = word.at;
    out->digit_count = slrt_take_digits(&word, &out->fraction);
    out->digits.end = word.at;
    if (!out->digit_count) return false;
    if (word.at == word.end) return true;
    if (*word.at != 'e' && *word.at != 'E') return false;
    word.at++;
    if (word.at < word.end && (*word.at == '-' || *word.at == '+')) down = *word.at++ == '-';
    if (word.at == word.end) return false;
    for (; word.at < word.end; word.at++) {
        if (*word.at < '0' || *word.at > '9') return false;
        if (exponent < 100000) exponent = 10 * exponent + (*word.at - '0');
    }
    out->exponent = down ? -exponent : exponent;
    return true;
}

/// A fixed-point number in words of 32 bits, least first. Half of the words are behind the point,
/// which is more than the smallest double needs.
enum { SLRT_FIXED_WORDS = 128, SLRT_FIXED_POINT = 64 };

/// Multiplies the words from `from` on by 10 and adds a digit there. False if the number becomes
/// too large.
static bool slrt_times_ten(uint32_t *fixed, uint32_t from, uint32_t digit) {
    uint64_t carry = digit;
    uint32_t i;
    for (i = from; i < SLRT_FIXED_WORDS; i++) {
        carry += (uint64_t)fixed[i] * 10;
        fixed[i] = (uint32_t)(carry & UINT32_MAX);
        carry >>= 32;
    }
    return !carry;
}

/// Divides by 10 to the `power`, at most 9, rounding down. Returns whether there was a remainder.
static bool slrt_over_tens(uint32_t *fixed, int32_t power) {
    uint64_t rest = 0, divisor = 1;
    uint32_t i = SLRT_FIXED_WORDS;
    for (; power; power--) divisor *= 10;
    while (i && !fixed[i - 1]) i--;
    while (i-- > 0) {
        rest = rest << 32 | fixed[i];
        fixed[i] = (uint32_t)(rest / divisor);
        rest %= divisor;
    }
    return rest != 0;
}

static bool slrt_bit(const uint32_t *fixed, int bit) {
    return fixed[bit / 32] >> bit % 32 & 1;
}

/// Rounds a fixed-point number to the nearest double, a tie to the even one. `rest`: a little is
/// missing. As bits; all ones in the exponent if it is too large.
static uint64_t slrt_round_fixed(const uint32_t *fixed, bool rest) {
    const int lowest = 32 * SLRT_FIXED_POINT - 1074; // the bit of the smallest double
    int top = 32 * SLRT_FIXED_WORDS - 1, low, i;
    uint64_t bits = 0;
    while (top >= 0 && !fixed[top / 32]) top -= 32;
    while (top >= 0 && !slrt_bit(fixed, top)) top--;
    low = top - 52 > lowest ? top - 52 : lowest;
    for (i = top; i >= low; i--) bits = bits << 1 | slrt_bit(fixed, i);
    for (i = 0; i < (low - 1) / 32 && !rest; i++) rest = fixed[i] != 0;
    if (fixed[i] & ((UINT32_C(1) << (low - 1) % 32) - 1)) rest = true;
    if (slrt_bit(fixed, low - 1) && (rest || (bits & 1))) bits++;
    // The leading bit adds 1 to the exponent, also where rounding carries into it.
    if (low - lowest > 2045) return UINT64_C(0x7ff) << 52;
    return bits + ((uint64_t)(low - lowest) << 52);
}

/// The nearest double; false if it is not finite. In integers alone, so no option for arithmetic
/// changes it. Below 1e-480 it is 0, as that is less than half the smallest double.
static bool slrt_decimal_value(const slrt_decimal *decimal, double *out) {
    uint32_t fixed[SLRT_FIXED_WORDS];
    int32_t power = decimal->exponent - (int32_t)decimal->fraction;
    const unsigned char *at;
    uint64_t bits;
    bool rest = false, any = false;
    memset(fixed, 0, sizeof fixed);
    for (at = decimal->digits.at; at < decimal->digits.end; at++) {
        if (*at == '.') continue;
        any = any || *at != '0';
        if (!slrt_times_ten(fixed, SLRT_FIXED_POINT, (uint32_t)*at - '0')) return false;
    }
    if (!any || power < -1000) {
        memset(fixed, 0, sizeof fixed);
        power = 0;
    }
    for (; power > 0; power--)
        if (!slrt_times_ten(fixed, SLRT_FIXED_POINT, 0)) return false;
    for (; power < -9; power += 9) rest = slrt_over_tens(fixed, 9) || rest;
    if (power < 0) rest = slrt_over_tens(fixed, -power) || rest;
    bits = slrt_round_fixed(fixed, rest);
    if (bits >> 52 == 0x7ff) return false;
    bits |= (uint64_t)decimal->negative << 63;
    memcpy(out, &bits, sizeof *out);
    return true;
}

/// Reads the next word of a line as a number. Coordinates are in the range of
/// slrt_is_coordinate.
static bool slrt_take_number(slrt_text *line, bool coordinate, double *out) {
    slrt_decimal decimal;
    if (!slrt_parse_decimal(slrt_take_word(line), &decimal) || !slrt_decimal_value(&decimal, out))
        return false;
    return !coordinate || slrt_is_coordinate(*out);
}

static bool slrt_read_start(slrt_text line, sl_runtime_viewpoint *out) {
    return slrt_take_number(&line, true, &out->x) && slrt_take_number(&line, true, &out->y) &&
           slrt_take_number(&line, false, &out->heading);
}

/// Each door that a seam is of has a name, each start three numbers, and a range one above 0.
static bool slrt_take_text(sl_runtime *rt, const slrt_section *section) {
    const uint32_t seam_doors = rt->door_count;
    slrt_text text, line;
    rt->door_count = 0;
    rt->text = section->items ? section->items : (const unsigned char *)"";
    rt->text_bytes = (size_t)section->count;
    text.at = rt->text;
    text.end = rt->text + rt->text_bytes;
    while (slrt_take_line(&text, &line)) {
        const slrt_text first = slrt_take_word(&line);
        sl_runtime_viewpoint start;
        if (slrt_word_is(&first, "range") &&
            (!slrt_take_number(&line, false, &rt->range) || !(rt->range > 0)))
            return false;
        if (slrt_word_is(&first, "start")) {
            if (!slrt_read_start(line, &start)) return false;
            rt->start_count++;
        }
        if (slrt_word_is(&first, "door")) {
            const slrt_text name = slrt_take_word(&line);
            if (name.at == name.end || name.end - name.at > INT32_MAX) return false;
            if (rt->door_count++ == INT32_MAX) return false;
        }
        if (slrt_word_is(&first, "mirror")) rt->mirrors = SL_RUNTIME_MIRRORS_NOT_BAKED;
    }
    return rt->door_count >= seam_doors;
}

/// A door of the text: its name, and whether it is open.
static sl_runtime_name slrt_text_door(const sl_runtime *rt, uint32_t door, bool *open) {
    sl_runtime_name name;
    slrt_text line = slrt_find_statement(rt, "door", door), word = slrt_take_word(&line);
    int i;
    name.text = (const char *)word.at;
    name.length = (uint32_t)(word.end - word.at);
    for (i = 0; i < 5; i++) word = slrt_take_word(&line); // four coordinates, and the state
    *open = !slrt_word_is(&word, "shut");
    return name;
}

static bool slrt_text_start(const sl_runtime *rt, uint32_t start, sl_runtime_viewpoint *out) {
    return slrt_read_start(slrt_find_statement(rt, "start", start), out);
}

#endif
