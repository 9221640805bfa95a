/// sightline-view: its arguments and its exit status. 0: done; 1: the work failed (no display); 2:
/// the arguments are wrong, or without a window an input file is. A window opens at once, whatever
/// the map; what is wrong with the file is told in it.
#include "app/bench.h"
#include "app/pictures.h"
#include "app/print.h"
#include "app/script.h"
#include "app/settings.h"
#include "app/start.h"
#include "app/turn.h"
#include "app/window.h"
#include "dialogs/dialog.h"
#include "dialogs/map_file.h"
#include "dialogs/opening.h"
#include "dialogs/recovery.h"
#include "sightline/io.h"
#include "sightline/support.h"

#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct arguments {
    const char *map, *screenshot, *script;
    sl_import_options options;
    bool has_start;
    sl_point start;
    double soak;
    bool bench, help, version;
    unsigned long frames;
    unsigned long long seed;
} arguments;

// --- options: one table for getopt, for --help and for the manual page

typedef struct option_row {
    const char *name, *argument, *help;
    int code;
} option_row;

static const option_row option_rows[] = {
    {"map", "NAME", "which map of a file that holds several", 'm'},
    {"slice", "Z", "cut a 3D model at this height (default: in its middle)", 'z'},
    {"layers", "LAYER,...", "which layers of a drawing or a tile map to read", 'l'},
    {"start-names", "NAME,...", "which objects of a game map are starts; 'none': no starts", 'n'},
    {"tolerance", "T", "largest distance of a curve from its walls", 't'},
    {"unit", "UNIT",
     "convert a drawing to this unit: mm cm m km in ft yd; 0.0254=m: its unit is 0.0254 m", 'u'},
    {"entrance", "W", "how wide openings to the outside are at most, where there is no start", 'w'},
    {"threshold", "T", "darkness from which a pixel is solid, up to 1", 'd'},
    {"doors", NULL, "keep the doors of the format as doors", 'r'},
    {"cells", NULL, "take the cells that the file has (GL nodes of a WAD)", 'c'},
    {"start", "X,Y", "where the eye begins; inside is all that starts reach", 'p'},
    {"script", "FILE", "run a script, without a window", 's'},
    {"screenshot", "OUT", "save the window as .png, .svg or .pdf, without a display", 'o'},
    {"bench", NULL, "print frame times, all layers but the heat map on, no display", 'b'},
    {"frames", "N", "number of frames for --bench (default 300)", 'f'},
    {"soak", "SECONDS", "send random events, without a display", 'k'},
    {"seed", "N", "seed of the random events (default 1)", 'e'},
    {"help", NULL, "show this text", 'h'},
    {"version", NULL, "show the version", 'v'},
};
enum { OPTION_COUNT = sizeof option_rows / sizeof *option_rows };

#define PURPOSE                                                                                    \
    "Shows a map or a baked .slv file, what is seen in it, and how that is computed.\n"            \
    "Press '?' in the window to list all keys."
#define SCRIPTS                                                                                    \
    "A script has a command on each line: open FILE; key NAME; down NAME; up NAME;\n"              \
    "action NAME; move X Y; click X Y; right X Y; drag X Y X2 Y2; wheel STEPS;\n"                  \
    "wait FRAMES; size W H; eye X Y HEADING [CONE]; text SCALE; density PIXELS; screenshot "       \
    "FILE;\n"                                                                                      \
    "save FILE; account FILE; export FOLDER; cameras FILE; save_cameras FILE;\n"                   \
    "drop FILE; type TEXT; expect TEXT;\n"                                                         \
    "print STATE (" PRINT_NAMES ");\n"                                                             \
    "fits (fails if a text does not fit its panel)."
#define STATUS                                                                                     \
    "Exit status: 0 done; 1 the work failed; 2 the arguments or an input file are\nwrong."

static void print_help(void) {
    puts("usage: sightline-view [MAP] [options]\n\n" PURPOSE "\n");
    for (size_t i = 0; i < OPTION_COUNT; i++) {
        const option_row *o = &option_rows[i];
        char head[40];
        snprintf(head, sizeof head, "--%s%s%s", o->name, o->argument ? " " : "",
                 o->argument ? o->argument : "");
        if (strlen(head) > 20)
            printf("  %s\n%23s%s\n", head, "", o->help);
        else
            printf("  %-21s%s\n", head, o->help);
    }
    puts("\n" SCRIPTS "\n\n" STATUS "\n\nexample:\n  sightline-view maps/office.map");
}

/// A manual page, in the macros of man(7).
static void print_manual(void) {
    puts(".TH SIGHTLINE\\-VIEW 1 \"" SIGHTLINE_DATE "\" \"sightline " SIGHTLINE_VERSION
         "\" \"Sightline\"\n"
         ".SH NAME\nsightline\\-view \\- viewer of 2D cell-and-portal visibility\n"
         ".SH SYNOPSIS\n.B sightline\\-view\n[MAP] [options]\n"
         ".SH DESCRIPTION\n" PURPOSE "\n.SH OPTIONS");
    for (size_t i = 0; i < OPTION_COUNT; i++) {
        const option_row *o = &option_rows[i];
        fputs(".TP\n.B \\-\\-", stdout);
        for (const char *at = o->name; *at; at++) printf(*at == '-' ? "\\-" : "%c", *at);
        printf(" %s\n%s%s\n", o->argument ? o->argument : "", *o->help == '\'' ? "\\&" : "",
               o->help);
    }
    puts(".SH SCRIPTS\n" SCRIPTS "\n.SH EXIT STATUS\n" STATUS "\n.SH SEE ALSO\n"
         ".BR sightline (1)");
}

static sl_status read_number(sl_context *context, const char *option, const char *text, double low,
                             double *value) {
    char *end;
    *value = strtod(text, &end);
    if (end == text || *end || !isfinite(*value) || *value < low)
        return sl_fail(context, SL_BAD_ARGUMENT, "%s %s: a number%s is needed", option, text,
                       low > 0 && low < 1 ? " over 0" : "");
    return SL_OK;
}

static sl_status read_point(sl_context *context, const char *option, const char *text,
                            sl_point *point) {
    char *end;
    point->x = strtod(text, &end);
    const bool comma = end != text && *end == ',';
    const char *second = end + 1;
    if (comma) point->y = strtod(second, &end);
    if (!comma || end == second || *end || !(fabs(point->x) <= SL_COORDINATE_MAX) ||
        !(fabs(point->y) <= SL_COORDINATE_MAX))
        return sl_fail(context, SL_BAD_ARGUMENT, "%s %s: a place is needed, as X,Y", option, text);
    return SL_OK;
}

static sl_status read_map_option(sl_context *context, int option, arguments *a) {
    sl_import_options *o = &a->options;
    switch (option) {
    case 'z':
        o->has_slice = true;
        return read_number(context, "--slice", optarg, -1e150, &o->slice);
    case 'm':
        o->map = optarg;
        return SL_OK;
    case 'l':
        o->layers = optarg;
        return SL_OK;
    case 'n':
        o->start_names = optarg;
        return SL_OK;
    case 't':
        return read_number(context, "--tolerance", optarg, 1e-300, &o->tolerance);
    case 'u':
        o->unit = optarg;
        return SL_OK;
    case 'w':
        return read_number(context, "--entrance", optarg, 1e-300, &o->entrance);
    case 'd':
        SL_TRY(read_number(context, "--threshold", optarg, 1e-300, &o->threshold));
        if (o->threshold <= 1) return SL_OK;
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--threshold %s: a number over 0, at most 1, is needed", optarg);
    case 'r':
        o->doors = true;
        return SL_OK;
    case 'c':
        o->cells = true;
        return SL_OK;
    default:
        a->has_start = true;
        return read_point(context, "--start", optarg, &a->start);
    }
}

static sl_status read_option(sl_context *context, int option, arguments *a) {
    double number;
    switch (option) {
    case 's':
        a->script = optarg;
        return SL_OK;
    case 'o':
        a->screenshot = optarg;
        return SL_OK;
    case 'b':
        a->bench = true;
        return SL_OK;
    case 'f':
        SL_TRY(read_number(context, "--frames", optarg, 1, &number));
        a->frames = (unsigned long)fmin(number, 1e6);
        return SL_OK;
    case 'k':
        return read_number(context, "--soak", optarg, 0, &a->soak);
    case 'e':
        SL_TRY(read_number(context, "--seed", optarg, 0, &number));
        a->seed = (unsigned long long)fmin(number, 9e15);
        return SL_OK;
    case 'h':
        a->help = true;
        return SL_OK;
    case 'v':
        a->version = true;
        return SL_OK;
    default:
        return read_map_option(context, option, a);
    }
}

static sl_status read_arguments(sl_context *context, int argc, char **argv, arguments *a) {
    struct option options[OPTION_COUNT + 1] = {{0}};
    for (size_t i = 0; i < OPTION_COUNT; i++)
        options[i] = (struct option){option_rows[i].name,
                                     option_rows[i].argument ? required_argument : no_argument,
                                     NULL, option_rows[i].code};
    *a = (arguments){.frames = 300, .seed = 1, .options = sl_import_options_default()};
    opterr = 0;
    for (int option; (option = getopt_long(argc, argv, ":h", options, NULL)) != -1;) {
        const char *given = argv[optind - 1];
        if (option == '?' || option == ':')
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "%s: %s; 'sightline-view --help' lists the options", given,
                           option == ':'                  ? "an argument is missing"
                           : optopt && strchr(given, '=') ? "takes no argument"
                                                          : "no such option");
        SL_TRY(read_option(context, option, a));
    }
    if (argc - optind > 1)
        return sl_fail(context, SL_BAD_ARGUMENT, "one map at a time, not also '%s'",
                       argv[optind + 1]);
    if (optind < argc) a->map = argv[optind];
    return SL_OK;
}

/// Starts to open the named map.
static sl_status open_map(app_state *app, const arguments *a, bool ask) {
    if (!a->map) return SL_OK;
    const document_source source = {.path = (char *)(uintptr_t)a->map,
                                    .options = a->options,
                                    .has_start = a->has_start,
                                    .start = a->start};
    return files_open_source(&app->desk, &source, ask);
}

/// Without a window a map that cannot be opened ends the program.
static sl_status run_headless(app_state *app, const arguments *a) {
    app->ui.steady = true;
    SL_TRY(open_map(app, a, false));
    bool changed;
    SL_TRY(document_wait(app->context, &app->document, &changed));
    app_take_opened(app);
    app_settle(app);
    if (a->script) SL_TRY(script_run(app, a->script, NULL, NULL));
    if (a->bench) SL_TRY(bench_run(app, (unsigned)a->frames));
    if (a->soak > 0) {
        app->ui.steady = false;
        SL_TRY(soak_run(app, a->soak, a->seed));
    }
    return a->screenshot ? save_window(app, a->screenshot) : SL_OK;
}

static sl_status run_window(app_state *app, const arguments *a) {
    app_window *window;
    settings_load(app);
    SL_TRY(window_open(app, false, &window));
    recovery_begin(&app->desk);
    if (!a->map && dialog_open_now(&app->desk.dialog) == DIALOG_NONE) files_browse(&app->desk);
    sl_status status = window_show(window);
    if (status == SL_OK) {
        map_file_check(&app->desk, a->map ? a->map : "", open_map(app, a, true));
        status = window_run(window);
    }
    window_close(window);
    if (status == SL_OK) settings_save(app);
    return status;
}

static sl_status run(sl_context *context, int argc, char **argv) {
    arguments a;
    SL_TRY(read_arguments(context, argc, argv, &a));
    if (a.help && a.map && strcmp(a.map, "man") == 0)
        print_manual();
    else if (a.help)
        print_help();
    if (a.version) puts("sightline-view " SIGHTLINE_VERSION);
    if (a.help || a.version) return SL_OK;
    app_state *app = sl_alloc_array(context, 1, sizeof *app);
    if (!app) return SL_NO_MEMORY;
    app_init(app, context);
    app->desk.options = a.options;
    const bool headless = a.script || a.screenshot || a.bench || a.soak > 0;
    const sl_status status = headless ? run_headless(app, &a) : run_window(app, &a);
    app_destroy(app);
    sl_free(context, app);
    return status;
}

int main(int argc, char **argv) {
    sl_context *context = sl_context_create(NULL);
    if (!context) {
        fputs("sightline-view: out of memory\n", stderr);
        return 1;
    }
    sl_status status = sl_io_use(context);
    if (status == SL_OK) status = run(context, argc, argv);
    if (status != SL_OK) fprintf(stderr, "sightline-view: %s\n", sl_context_message(context));
    sl_context_destroy(context);
    const bool input =
        status == SL_BAD_ARGUMENT || status == SL_BAD_INPUT || status == SL_UNSUPPORTED;
    return status == SL_OK ? 0 : input ? 2 : 1;
}
