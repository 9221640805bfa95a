/// What a script can have printed: the state that pictures show, a fact a line, the name first.
#include "app/print.h"

#include "lessons/quiz.h"
#include "panes/panel.h"
#include "panes/panes.h"
#include "plan/cameras.h"
#include "plan/heat.h"

#include <math.h>
#include <string.h>

static void print_conflict(const sl_conflict *conflict, FILE *out) {
    static const char *const verdicts[] = {
        [SL_HIDDEN] = "hidden", [SL_GRAZING] = "grazing", [SL_STABBED] = "stabbed"};
    fprintf(out, "conflict: %s%s", verdicts[conflict->verdict], conflict->turns ? " turns" : "");
    for (uint32_t i = 0; i < conflict->end_count; i++)
        fprintf(out, " %c%u", conflict->ends[i].left ? 'L' : 'R', conflict->ends[i].portal + 1);
    fputc('\n', out);
}

static void print_chosen(const char *name, uint32_t chosen, FILE *out) {
    char text[48] = "nothing";
    if (chosen == CHOSEN_LINE)
        snprintf(text, sizeof text, "the line");
    else if (chosen != CHOSEN_NONE)
        lesson_name_end(chosen, text);
    fprintf(out, "%s: %s\n", name, text);
}

static void print_lesson(app_state *app, FILE *out) {
    lesson_state *lesson = &app->learn.lesson;
    char text[SENTENCE];
    sl_status status;
    fprintf(out, "lesson: %s\n", lesson_subject(lesson)->title);
    if (!lesson_shows(lesson, &app->document)) return;
    lesson_sentence(lesson, &app->document, text);
    fprintf(out, "step: %zu of %zu\n", lesson->at + 1, lesson_length(lesson));
    fprintf(out, "sentence: %s\n", text);
    fprintf(out, "steps a second: %g\n", ldexp(2, lesson->speed));
    print_conflict(lesson_conflict(app->context, lesson, &status), out);
    for (uint32_t i = 0; i < lesson->end_count; i++) {
        const sl_portal_ends *at = &lesson->ends[i];
        fprintf(out, "portal %u: left %.17g %.17g right %.17g %.17g\n", i + 1, at->left.x,
                at->left.y, at->right.x, at->right.y);
    }
    fprintf(out, "line: slope %.9g height %.9g\n", lesson->line.slope, lesson->line.height);
    fprintf(out, "dragged: %s\n", lesson->dragged ? "yes" : "no");
    print_chosen("chosen", lesson_chosen(lesson), out);
    print_chosen("hovered", lesson->hovered ? lesson->hovered - 1 : CHOSEN_NONE, out);
    fprintf(out, "hovered step: %zu\n", lesson->hovered_step);
}

static void print_program(app_state *app, FILE *out) {
    lesson_state *lesson = &app->learn.lesson;
    sl_status status = SL_OK;
    const sl_program *p = lesson->end_count ? lesson_program(app->context, lesson, &status) : NULL;
    if (!p) {
        fprintf(out, "program: %s\n",
                status == SL_OK ? "no portals" : sl_context_message(app->context));
        return;
    }
    fprintf(out, "program: %u rows, %s\n", p->row_count, p->solved ? "solved" : "no optimum");
    fprintf(out, "margin: %.9g\n", p->margin);
    for (uint32_t i = 0; i < p->row_count; i++) {
        const sl_program_row *row = &p->rows[i];
        if (row->portal == SL_PROGRAM_FIXED)
            fputs("row |u|:", out);
        else
            fprintf(out, "row %c%u:", row->left ? 'L' : 'R', row->portal + 1);
        for (int k = 0; k < SL_PROGRAM_COLUMNS; k++) fprintf(out, " %.9g", row->coefficients[k]);
        fprintf(out, " value %.9g price %.9g %s\n", row->value, row->price,
                row->basic ? "basic" : "tight");
    }
}

static void print_why(app_state *app, FILE *out) {
    const quiz_state *q = &app->learn.quiz;
    const sl_explanation *e = &q->explanation;
    char text[1024];
    if (!q->answered) {
        fputs("why: nothing was asked\n", out);
        return;
    }
    quiz_words(&app->learn, text, sizeof text);
    fprintf(out, "why: cell %u to cell %u\n", q->from, q->to);
    fprintf(out, "words: %s\n", text);
    if (!e->miss_count) return;
    const sl_sequence *sequence = &e->misses[0].sequence;
    sl_conflict conflict = {
        .verdict = SL_HIDDEN, .turns = e->misses[0].turns, .end_count = sequence->end_count};
    memcpy(conflict.ends, sequence->ends, sizeof conflict.ends);
    print_conflict(&conflict, out);
}

static void print_quiz(app_state *app, FILE *out) {
    const quiz_state *q = &app->learn.quiz;
    fprintf(out, "quiz: cell %u to cell %u\n", q->from, q->to);
    fprintf(out, "answers: %u of %u right\n", q->right_count, q->asked_count);
}

static void print_bar(app_state *app, FILE *out) {
    char text[BAR_TEXT] = "nothing";
    if (pane_time_shown(&app->learn)) pane_time_sentence(&app->learn, text);
    fprintf(out, "bar: %s\n", text);
}

static void print_legend(app_state *app, FILE *out) {
    const ui_state *ui = &app->ui;
    fprintf(out, "legend: %s\n", !ui->legend ? "off" : ui->legend_folded ? "a button" : "on");
}

static void print_first_person(app_state *app, FILE *out) {
    const first_person_counts *c = &app->view.first_person;
    fprintf(out, "pieces: %u\nmirrors: %u\nreflected: %u\n", c->pieces, c->mirrors, c->reflected);
    fprintf(out, "leaves: %u\nframes: %u\ndark: %u\ntinted: %u\n", c->leaves, c->frames, c->dark,
            c->tinted);
}

static void print_place(app_state *app, FILE *out) {
    char text[512];
    pane_say_place(&app->view, text, sizeof text);
    fprintf(out, "place: %s\n", text);
}

static void print_doors(app_state *app, FILE *out) {
    const sl_map *map = &app->document.map;
    for (size_t i = 0; i < map->door_count; i++)
        fprintf(out, "door %s: %s\n", map->doors[i].name, map->doors[i].open ? "open" : "shut");
}

static void print_heat(app_state *app, FILE *out) {
    const heat_graph *graph;
    double least, most;
    legend_key key;
    char text[64];
    heat_say_measure(&app->view, text);
    fprintf(out, "heat map: %s\n", text);
    fprintf(out, "step: %.9g\n", heat_step(&app->view));
    const double *values = heat_layer_values(&app->view, &graph);
    if (!values || !heat_layer_key(&app->view, &key)) {
        fputs("values: none\n", out);
        return;
    }
    heat_layer_scale(&app->view, &least, &most);
    fprintf(out, "scale: %.9g to %.9g\n", least, most);
    fprintf(out, "pointer: %s\n", key.rows[1].text);
    for (uint32_t p = 0; p < graph->grid.count; p++)
        fprintf(out, "point %.9g %.9g: %.9g\n", graph->grid.points[p].x, graph->grid.points[p].y,
                values[p]);
}

static void print_cameras(app_state *app, FILE *out) {
    const camera_layer *layer = app->view.cameras;
    if (!layer) {
        fputs("cameras: none\n", out);
        return;
    }
    fprintf(out, "cameras: %zu\n", layer->table.count);
    fprintf(out, "chosen: %zu\n", layer->chosen == SIZE_MAX ? 0 : layer->chosen + 1);
    for (size_t i = 0; i < layer->table.count; i++) {
        const sl_viewpoint *v = &layer->table.items[i].view;
        char name[CAMERA_NAME];
        camera_name(layer, i, name);
        fprintf(out, "camera %s: %.9g %.9g heading %.9g fov %.9g range %.9g\n", name, v->at.x,
                v->at.y, v->heading, v->fov, v->range);
    }
    fprintf(out, "proof: %s\n", layer->proof);
    if (!layer->known || layer->seen_stamp != layer->stamp) return;
    for (uint32_t i = 0; i < SL_COVERAGE_CLASSES; i++)
        fprintf(out, "class %u: %.9g\n", i, sl_coverage_class_area(&layer->coverage, i));
    for (size_t i = 0; i < layer->table.count; i++)
        fprintf(out, "sees %zu: %.9g %s\n", i + 1, layer->coverage.seen[i],
                sl_coverage_is_spare(&layer->coverage, i) ? "spare" : "needed");
    for (uint32_t i = 0; i < layer->coverage.blind_count; i++)
        fprintf(out, "blind %u: %.9g at %.9g %.9g\n", i + 1, layer->coverage.blind[i].area,
                layer->coverage.blind[i].at.x, layer->coverage.blind[i].at.y);
}

bool print_state(app_state *app, const char *what, FILE *out) {
    static const struct {
        const char *name;
        void (*print)(app_state *app, FILE *out);
    } states[] = {
        {"lesson", print_lesson}, {"program", print_program}, {"why", print_why},
        {"quiz", print_quiz},     {"doors", print_doors},     {"first_person", print_first_person},
        {"heat", print_heat},     {"cameras", print_cameras}, {"bar", print_bar},
        {"legend", print_legend}, {"place", print_place}};
    for (size_t i = 0; i < sizeof states / sizeof *states; i++)
        if (strcmp(states[i].name, what) == 0) {
            states[i].print(app, out);
            return true;
        }
    return false;
}
