/// Portal sequences as text, the files tests/cases/*.portals:
///
///     # what makes it hard
///     portal LX LY RX RY      left and right end, in the order of crossing
///     verdict hidden|grazing|stabbed
///
/// '#' starts a comment; the first line is one. Numbers are decimal or hexadecimal (0x1.8p1), which
/// reads back to the same double. The verdict stands last.
#ifndef SL_TESTS_PORTALS_TEXT_H
#define SL_TESTS_PORTALS_TEXT_H

#include "sightline/support.h"
#include "solver_table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct portals_text {
    char what[256]; ///< the first line
    oracle_portal *portals;
    size_t count;
    sl_stab_verdict verdict;
} portals_text;

static inline void portals_text_free(portals_text *text) {
    free(text->portals);
    *text = (portals_text){0};
}

static inline bool portals_text_verdict(const char *word, sl_stab_verdict *out) {
    for (int i = SL_HIDDEN; i <= SL_STABBED; i++) {
        if (strcmp(word, verdict_name((sl_stab_verdict)i))) continue;
        *out = (sl_stab_verdict)i;
        return true;
    }
    return false;
}

static inline bool portals_text_number(const char *word, double *out) {
    char *end;
    *out = strtod(word, &end);
    const double size = fabs(*out);
    return end != word && !*end &&
           (size == 0 || (size >= SL_COORDINATE_MIN && size <= SL_COORDINATE_MAX));
}

/// One statement, of words; NULL or what is wrong with it.
static inline const char *portals_text_statement(portals_text *text, char *words[6], size_t count,
                                                 bool *ended) {
    if (*ended) return "something behind the verdict";
    if (strcmp(words[0], "verdict") == 0) {
        *ended = true;
        if (!text->count) return "a verdict on no portal";
        return count == 2 && portals_text_verdict(words[1], &text->verdict) ? NULL : "no verdict";
    }
    if (strcmp(words[0], "portal") != 0) return "an unknown statement";
    if (count != 5) return "a portal is four numbers";
    double v[4];
    for (int i = 0; i < 4; i++)
        if (!portals_text_number(words[i + 1], &v[i])) return "no usable number";
    if (v[0] == v[2] && v[1] == v[3]) return "a portal without length";
    text->portals = realloc(text->portals, (text->count + 1) * sizeof *text->portals);
    if (!text->portals) abort();
    text->portals[text->count++] = (oracle_portal){{v[0], v[1]}, {v[2], v[3]}};
    return NULL;
}

/// Reads a stream to its end. NULL, or what is wrong with line *number.
static inline const char *portals_text_read(FILE *in, portals_text *text, unsigned *number) {
    char line[512], *words[6], *rest;
    bool ended = false;
    *text = (portals_text){0};
    for (*number = 1; fgets(line, sizeof line, in); ++*number) {
        if (!strchr(line, '\n')) return "a line without end";
        if (*number == 1) {
            if (line[0] != '#' || strspn(line + 1, " \n") == strlen(line + 1))
                return "the first line does not tell what makes the case hard";
            snprintf(text->what, sizeof text->what, "%.*s", (int)strcspn(line + 2, "\n"), line + 2);
        }
        line[strcspn(line, "#\n")] = 0;
        size_t count = 0;
        for (char *word = strtok_r(line, " \t", &rest); word && count < 6;
             word = strtok_r(NULL, " \t", &rest))
            words[count++] = word;
        const char *fault = count ? portals_text_statement(text, words, count, &ended) : NULL;
        if (fault) return fault;
    }
    return ended ? NULL : "no verdict at the end";
}

/// A double as a decimal where that is short, else hexadecimal.
static inline void portals_text_print_number(FILE *out, double value) {
    char text[SL_NUMBER_TEXT];
    sl_number_write(value, text);
    if (strlen(text) <= 8)
        fprintf(out, " %s", text);
    else
        fprintf(out, " %a", value);
}

static inline void portals_text_print(FILE *out, const char *what, const oracle_portal *portals,
                                      size_t count, sl_stab_verdict verdict) {
    fprintf(out, "# %s\n", what);
    for (size_t i = 0; i < count; i++) {
        const oracle_portal *p = &portals[i];
        fputs("portal", out);
        portals_text_print_number(out, p->left.x);
        portals_text_print_number(out, p->left.y);
        portals_text_print_number(out, p->right.x);
        portals_text_print_number(out, p->right.y);
        fputc('\n', out);
    }
    fprintf(out, "verdict %s\n", verdict_name(verdict));
}

#endif
