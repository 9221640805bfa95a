/// What files of proofs share: JSON whose members come in one order, and the parts that all of them
/// have. The reader takes no other order, so that it needs no tree.
#ifndef SLI_PROOF_JSON_H
#define SLI_PROOF_JSON_H

#include "sightline/set_cover.h"
#include "sightline/space.h"
#include "sightline/support.h"

#include <stdio.h>

typedef SL_ARRAY(uint64_t) sli_proof_numbers;
typedef SL_ARRAY(sl_point) sli_proof_points;

/// The versions of files: of viewpoints anywhere, and among given places.
enum { SLI_PROOF_ANYWHERE = 1, SLI_PROOF_AREA = 2 };

/// One number more in a sum that keeps mistakes away, not forgers.
uint64_t sli_proof_mix(uint64_t sum, uint64_t more);
uint64_t sli_proof_mix_real(uint64_t sum, double more);
uint64_t sli_proof_mix_point(uint64_t sum, sl_point more);

// --- writing

/// The version, and which walls it is of.
void sli_proof_put_head(FILE *f, uint64_t version, const sl_space *space);
/// Points, each at the start of an item of `size`.
void sli_proof_put_points(FILE *f, const char *name, const void *items, size_t size, size_t count);
void sli_proof_put_numbers(FILE *f, const char *name, const uint32_t *numbers, size_t count);
void sli_proof_put_cover(FILE *f, const sl_cover_proof *proof);
/// The integer program in CPLEX' LP format, for other solvers; it ends the file.
sl_status sli_proof_put_program(sl_context *context, FILE *f, const sl_cover_problem *problem);

// --- reading

typedef struct sli_proof_reader {
    sl_context *context;
    const char *path, *at, *end, *member;
    unsigned line;
} sli_proof_reader;

/// From the start of a text, behind a byte order mark.
sli_proof_reader sli_proof_reader_of(sl_context *context, const char *path, const char *text,
                                     size_t size);
sl_status sli_proof_fail(const sli_proof_reader *r, const char *what);
/// The key of the next member.
sl_status sli_proof_key(sli_proof_reader *r, const char *name);
/// A member that is a whole number up to `most`.
sl_status sli_proof_member(sli_proof_reader *r, const char *name, uint64_t most, uint64_t *out);
/// A list of whole numbers, added to those that are there; null is `none`, where that is over
/// `most`.
sl_status sli_proof_list(sli_proof_reader *r, uint64_t most, uint64_t none, sli_proof_numbers *out);
/// A member that is a list of points.
sl_status sli_proof_read_points(sli_proof_reader *r, const char *name, sli_proof_points *out);
/// A list of lists of whole numbers; of `width` each, unless that is 0. Their ends go to `ends`.
sl_status sli_proof_table(sli_proof_reader *r, const char *name, size_t width, uint64_t most,
                          uint64_t none, sli_proof_numbers *out, sli_proof_numbers *ends);
/// Refuses another version, and a proof of another map.
sl_status sli_proof_read_head(sli_proof_reader *r, uint64_t version, const sl_space *space);
/// What sli_proof_put_cover() wrote, of so many rows.
sl_status sli_proof_read_cover(sli_proof_reader *r, uint32_t rows, sl_cover_proof *out);
/// Passes over the program, which is for others, and expects the end.
sl_status sli_proof_read_end(sli_proof_reader *r);

#endif
