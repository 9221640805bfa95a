// The map text of a hostile file: lines, words and the parts of decimals are taken from within the
// text, and their counts fit. Text of up to 6 bytes.
//
// unwind 8
#include "proof.h"

#define SLRT_BIG_ENDIAN // numbers byte by byte
#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#include "runtime/sightline_runtime.h"

enum { MOST = 6 };

void a_line_lies_in_the_text(void) {
    const size_t size = nondet_ulong();
    ASSUME(size <= MOST);
    ANY_BYTES(bytes, MOST, size);
    slrt_text text = {bytes, bytes + size}, line;
    if (!slrt_take_line(&text, &line)) return;
    PROVE(line.at >= bytes && line.at <= line.end && line.end <= bytes + size);
    PROVE(text.at > bytes && text.at <= bytes + size);
}

void a_word_lies_in_its_line(void) {
    const size_t size = nondet_ulong();
    ASSUME(size <= MOST);
    ANY_BYTES(bytes, MOST, size);
    slrt_text line = {bytes, bytes + size};
    const slrt_text word = slrt_take_word(&line);
    PROVE(word.at >= bytes && word.at <= word.end && word.end <= bytes + size);
    PROVE(line.at >= word.end && line.at <= bytes + size);
    slrt_word_is(&word, "door");
}

void decimals_fit(void) {
    const size_t size = nondet_ulong();
    ASSUME(size <= MOST);
    ANY_BYTES(bytes, MOST, size);
    const slrt_text word = {bytes, bytes + size};
    slrt_decimal decimal;
    if (!slrt_parse_decimal(word, &decimal)) return;
    PROVE(decimal.digits.at >= bytes && decimal.digits.end <= bytes + size);
    PROVE(decimal.fraction <= decimal.digit_count && decimal.digit_count <= size);
    PROVE(decimal.exponent > -1000000 && decimal.exponent < 1000000);
}
