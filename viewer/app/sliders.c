/// The share, the words and the setting of each slider.
#include "app/sliders.h"

#include "dialogs/opening.h"
#include "document/measure.h"
#include "plan/cameras.h"
#include "plan/effects.h"
#include "plan/heat.h"
#include "plan/layers.h"
#include "plan/view_cells.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/// A length over 0 that one can read.
static double two_digits(double length) {
    const double digit = pow(10, floor(log10(length)) - 1);
    return digit * round(length / digit);
}

// --- the view cone: finer where it is narrow

static bool has_eye(const app_state *app) {
    return app->view.mode != MODE_CAMERAS &&
           !(app->view.mode == MODE_PLAN && tool_paints(app->view.tool));
}

static double cone_share(const app_state *app) {
    return sqrt((app->view.eye.fov - 1) / 359);
}

static void cone_text(const app_state *app, char text[SLIDER_TEXT]) {
    snprintf(text, SLIDER_TEXT, "%.4g\xc2\xb0", app->view.eye.fov);
}

static bool type_cone(app_state *app, double degrees) {
    if (degrees < 1 || degrees > 360) return false;
    app->view.eye.fov = degrees;
    return true;
}

static void set_cone(app_state *app, double share) {
    app->view.eye.fov = round(1 + 359 * share * share);
}

// --- the height at which a 3D model is cut

static bool is_model(const app_state *app) {
    return app->document.source.highest > app->document.source.lowest;
}

static double cut_share(const app_state *app) {
    const document_source *s = &app->document.source;
    return (s->options.slice - s->lowest) / (s->highest - s->lowest);
}

static void cut_text(const app_state *app, char text[SLIDER_TEXT]) {
    snprintf(text, SLIDER_TEXT, "%.5g", app->document.source.options.slice);
}

static void set_cut(app_state *app, double share) {
    const document_source *source = &app->document.source;
    sl_import_options options = source->options;
    options.slice = source->lowest + share * (source->highest - source->lowest);
    if (options.slice != source->options.slice) files_open_again(&app->desk, &options);
}

// --- how deep splits are shown

static bool has_splits(const app_state *app) {
    return app->document.baked && layers_shows(&app->view, LAYER_SPLITS);
}

static double deepest_split(const app_state *app) {
    return fmax(app->document.baked->space.tree_depth, 1);
}

static double split_share(const app_state *app) {
    return app->view.split_depth / deepest_split(app);
}

static void split_text(const app_state *app, char text[SLIDER_TEXT]) {
    snprintf(text, SLIDER_TEXT, "%.0f", fmin(app->view.split_depth, deepest_split(app)));
}

static void set_split(app_state *app, double share) {
    app->view.split_depth = (uint32_t)fmax(1, round(share * deepest_split(app)));
}

// --- how far the stab tree is grown

static bool has_tree(const app_state *app) {
    return app->view.show & SHOW_TREE && app->view.tree;
}

static double tree_share(const app_state *app) {
    return app->view.tree_depth / fmax(sl_scene_tree_depth(app->view.tree), 1);
}

static void tree_text(const app_state *app, char text[SLIDER_TEXT]) {
    snprintf(text, SLIDER_TEXT, "%.0f",
             fmin(app->view.tree_depth, sl_scene_tree_depth(app->view.tree)));
}

static void set_tree(app_state *app, double share) {
    app->view.tree_depth = (uint32_t)round(share * sl_scene_tree_depth(app->view.tree));
}

// --- the walk through the merge history: from one view cell to all elementary ones, finer where
// there are few

static bool has_views(const app_state *app) {
    return app->view.show & SHOW_VIEWS && view_layer_most(app->view.views) > 1;
}

static double views_share(const app_state *app) {
    return log(view_layer_shown(app->view.views)) / log(view_layer_most(app->view.views));
}

static void views_text(const app_state *app, char text[SLIDER_TEXT]) {
    snprintf(text, SLIDER_TEXT, "%u", view_layer_shown(app->view.views));
}

static void set_views(app_state *app, double share) {
    const double most = view_layer_most(app->view.views);
    view_layer_go(&app->view, (uint32_t)round(pow(most, share)));
}

// --- the grid of the heat map, from coarse to fine

static bool has_heat(const app_state *app) {
    return app->document.baked && layers_shows(&app->view, LAYER_HEAT);
}

static double heat_share(const app_state *app) {
    int last;
    const int place = heat_step_place(&app->view, &last);
    return (double)place / fmax(last, 1);
}

/// "1.5 m", where the map has a unit.
static void length_text(const app_state *app, double length, char text[SLIDER_TEXT]) {
    char whole[MEASURE_TEXT];
    measure_say(length, app->document.map.unit, "", whole);
    snprintf(text, SLIDER_TEXT, "%.*s", SLIDER_TEXT - 1, whole);
}

static void heat_text(const app_state *app, char text[SLIDER_TEXT]) {
    length_text(app, heat_step(&app->view), text);
}

static bool type_heat(app_state *app, double step) {
    return heat_type_step(&app->view, step);
}

static void set_heat(app_state *app, double share) {
    int last;
    heat_step_place(&app->view, &last);
    heat_set_step(&app->view, (int)round(share * last));
}

// --- the view range, finer where it is short

static bool has_range(const app_state *app) {
    return app->document.baked && app->document.map.range > 0;
}

static double range_share(const app_state *app) {
    return sqrt(fmin(app->document.map.range / range_most(&app->document), 1));
}

static void range_text(const app_state *app, char text[SLIDER_TEXT]) {
    snprintf(text, SLIDER_TEXT, "%.3g", app->document.map.range);
}

static void set_range(app_state *app, double share) {
    range_set(&app->view, share * share * range_most(&app->document));
}

// --- how often a sightline is reflected

static bool has_mirrors(const app_state *app) {
    return app->document.baked && app->document.map.mirror_count;
}

static double depth_share(const app_state *app) {
    return (double)app->document.mirror_depth / MIRROR_DEPTH_MOST;
}

static void depth_text(const app_state *app, char text[SLIDER_TEXT]) {
    snprintf(text, SLIDER_TEXT, "%u", app->document.mirror_depth);
}

static void set_depth(app_state *app, double share) {
    mirror_set_depth(&app->view, (uint32_t)round(share * MIRROR_DEPTH_MOST));
}

// --- the chosen camera

static bool has_camera(const app_state *app) {
    return app->view.mode == MODE_CAMERAS && app->document.baked && camera_chosen(&app->view);
}

static bool has_camera_cone(const app_state *app) {
    return has_camera(app) && camera_chosen(&app->view)->fov < 360;
}

static double field_share(const app_state *app) {
    return (camera_chosen(&app->view)->fov - 5) / 355;
}

static void field_text(const app_state *app, char text[SLIDER_TEXT]) {
    snprintf(text, SLIDER_TEXT, "%.4g\xc2\xb0", camera_chosen(&app->view)->fov);
}

static bool type_field(app_state *app, double degrees) {
    const sl_camera *row = camera_chosen_row(&app->view);
    if (!(degrees > 0) || degrees > 360) return false;
    camera_tilt(&app->view, degrees, row->height, row->tilt);
    return true;
}

static void set_field(app_state *app, double share) {
    const sl_camera *row = camera_chosen_row(&app->view);
    camera_tilt(&app->view, round(5 + 355 * share), row->height, row->tilt);
}

static double heading_share(const app_state *app) {
    return camera_chosen(&app->view)->heading / 360;
}

static void heading_text(const app_state *app, char text[SLIDER_TEXT]) {
    snprintf(text, SLIDER_TEXT, "%.4g\xc2\xb0", camera_chosen(&app->view)->heading);
}

static bool type_heading(app_state *app, double degrees) {
    if (degrees < -360 || degrees > 360) return false;
    camera_chosen(&app->view)->heading = degrees < 0 ? degrees + 360 : fmod(degrees, 360);
    camera_changed(&app->view);
    return true;
}

static void set_heading(app_state *app, double share) {
    camera_chosen(&app->view)->heading = fmod(round(360 * share), 360);
    camera_changed(&app->view);
}

static double camera_range_share(const app_state *app) {
    const double range = camera_chosen(&app->view)->range;
    return range > 0 ? sqrt(fmin(range / range_most(&app->document), 1)) : 1;
}

static void camera_range_text(const app_state *app, char text[SLIDER_TEXT]) {
    const double range = camera_chosen(&app->view)->range;
    if (range > 0)
        length_text(app, range, text);
    else
        snprintf(text, SLIDER_TEXT, "no limit");
}

static bool type_camera_range(app_state *app, double range) {
    if (!(range >= 0)) return false;
    app->view.cameras->like.range = range;
    camera_range(&app->view, range);
    return true;
}

static void set_camera_range(app_state *app, double share) {
    const double range = share < 1 ? fmax(share * share, 1e-3) * range_most(&app->document) : 0;
    app->view.cameras->like.range = range;
    camera_range(&app->view, range);
}

// --- the ground that it sees: its height, finer where it is low, and its tilt

static bool has_camera_height(const app_state *app) {
    return has_camera(app) && camera_chosen(&app->view)->fov < 180;
}

static double highest_camera(const app_state *app) {
    return range_most(&app->document) / 4;
}

static double height_share(const app_state *app) {
    return sqrt(fmin(camera_chosen_row(&app->view)->height / highest_camera(app), 1));
}

static void height_text(const app_state *app, char text[SLIDER_TEXT]) {
    const double height = camera_chosen_row(&app->view)->height;
    if (height > 0)
        length_text(app, height, text);
    else
        snprintf(text, SLIDER_TEXT, "not known");
}

static bool type_height(app_state *app, double height) {
    const sl_camera *row = camera_chosen_row(&app->view);
    if (!(height >= 0)) return false;
    camera_tilt(&app->view, row->view.fov, height, row->tilt);
    return true;
}

static void set_height(app_state *app, double share) {
    const sl_camera *row = camera_chosen_row(&app->view);
    camera_tilt(&app->view, row->view.fov,
                share > 0.01 ? two_digits(share * share * highest_camera(app)) : 0, row->tilt);
}

static bool has_tilt(const app_state *app) {
    return has_camera_height(app) && camera_chosen_row(&app->view)->height > 0;
}

static double tilt_share(const app_state *app) {
    return camera_chosen_row(&app->view)->tilt / 90;
}

static void tilt_text(const app_state *app, char text[SLIDER_TEXT]) {
    snprintf(text, SLIDER_TEXT, "%.4g\xc2\xb0", camera_chosen_row(&app->view)->tilt);
}

static bool type_tilt(app_state *app, double degrees) {
    const sl_camera *row = camera_chosen_row(&app->view);
    if (!(degrees >= 0) || degrees > 90) return false;
    camera_tilt(&app->view, row->view.fov, row->height, degrees);
    return true;
}

static void set_tilt(app_state *app, double share) {
    const sl_camera *row = camera_chosen_row(&app->view);
    camera_tilt(&app->view, row->view.fov, row->height, round(90 * share));
}

// --- who walks a path: finer where it is thin

static bool has_walker(const app_state *app) {
    return app->view.mode == MODE_PLAN && app->view.tool == TOOL_PATH && app->document.baked;
}

/// The widest walker, by the map's size.
static double widest_walker(const app_state *app) {
    const sl_box b = app->document.baked->space.bounds;
    return fmin(b.max.x - b.min.x, b.max.y - b.min.y) / 20;
}

static double walker_share(const app_state *app) {
    return sqrt(fmin(app->view.walker / widest_walker(app), 1));
}

static void walker_text(const app_state *app, char text[SLIDER_TEXT]) {
    if (app->view.walker > 0)
        length_text(app, app->view.walker, text);
    else
        snprintf(text, SLIDER_TEXT, "a point");
}

static bool type_walker(app_state *app, double radius) {
    if (!(radius >= 0) || radius > widest_walker(app)) return false;
    app->view.walker = radius;
    return true;
}

static void set_walker(app_state *app, double share) {
    app->view.walker = share > 0.01 ? two_digits(share * share * widest_walker(app)) : 0;
}

static const slider_row sliders[] = {
    {"View cone", has_eye, cone_share, cone_text, set_cone, NULL, NULL,
     "How wide the eye sees (, and .)", type_cone},
    {"Radius", has_walker, walker_share, walker_text, set_walker, NULL, NULL,
     "Half the width of who walks the path: gaps that are too narrow are not passed", type_walker},
    {"View range", has_range, range_share, range_text, set_range, view_keep, range_settle,
     "Nothing farther than this is seen (Ctrl+R sets and lifts it)", NULL},
    {"Reflections", has_mirrors, depth_share, depth_text, set_depth, NULL, mirror_settle_depth,
     "How often a sightline is reflected at most", NULL},
    {"Cut at", is_model, cut_share, cut_text, set_cut, NULL, NULL,
     "The height at which the model is cut (Ctrl+Up, Ctrl+Down)", NULL},
    {"Split depth", has_splits, split_share, split_text, set_split, NULL, NULL,
     "Splits of the tree down to this depth ([ and ])", NULL},
    {"Tree grown", has_tree, tree_share, tree_text, set_tree, NULL, NULL,
     "Sequences of the stab tree up to this many portals (- and =)", NULL},
    {"View cells", has_views, views_share, views_text, set_views, NULL, NULL,
     "From one view cell to all elementary ones (Ctrl+Left, Ctrl+Right)", NULL},
    {"Grid step", has_heat, heat_share, heat_text, set_heat, NULL, NULL,
     "From point to point of the heat map (4 coarser, 5 finer)", type_heat},
    {"Field of view", has_camera, field_share, field_text, set_field, camera_keep, camera_settle,
     "How wide the chosen camera sees (, and .)", type_field},
    {"Heading", has_camera_cone, heading_share, heading_text, set_heading, camera_keep,
     camera_settle, "Where it looks: from right, counter-clockwise (Left and Right)", type_heading},
    {"Range", has_camera, camera_range_share, camera_range_text, set_camera_range, camera_keep,
     camera_settle, "How far it sees (- and =)", type_camera_range},
    {"Height", has_camera_height, height_share, height_text, set_height, camera_keep, camera_settle,
     "How high over the ground it hangs: it sees nothing just below it", type_height},
    {"Tilt", has_tilt, tilt_share, tilt_text, set_tilt, camera_keep, camera_settle,
     "How far it looks down: it sees no ground past the upper border of its picture", type_tilt},
};

const slider_row *slider_table(size_t *count) {
    *count = sizeof sliders / sizeof *sliders;
    return sliders;
}

// --- typed

/// The one that is shown and typed behind `number`, from the first on after the last; -1: none.
static int next_typed(const app_state *app, int number) {
    enum { COUNT = sizeof sliders / sizeof *sliders };
    for (int k = 1; k <= (int)COUNT; k++) {
        const int i = (number + k) % (int)COUNT;
        if (sliders[i].type && sliders[i].shown(app)) return i;
    }
    return -1;
}

/// The number that a value begins with.
static void number_text(const app_state *app, int number, char text[SLIDER_TEXT]) {
    sliders[number].text(app, text);
    text[strspn(text, "0123456789.+-eE")] = '\0';
}

void slider_type(app_state *app, int number) {
    ui_state *ui = &app->ui;
    if (number < 0) number = next_typed(app, ui_types_value(ui) ? ui->typed_slider : -1);
    if (number < 0 || !sliders[number].type || !sliders[number].shown(app)) {
        ui_say(ui, false, "no value can be typed here");
        return;
    }
    char text[SLIDER_TEXT];
    number_text(app, number, text);
    ui->side_panel = true;
    field_set(&app->view.name, text);
    app->view.name.chosen = true;
    ui->field = &app->view.name;
    ui->number = ui->field;
    ui->typed_slider = number;
}

bool slider_typed(app_state *app) {
    const slider_row *s = &sliders[app->ui.typed_slider];
    char text[SLIDER_TEXT];
    double value;
    if (!s->shown(app)) return true; // it went away
    number_text(app, app->ui.typed_slider, text);
    if (strcmp(text, app->view.name.text) == 0)
        return true; // as it was, which may have more digits
    snprintf(text, sizeof text, "%.*s", SLIDER_TEXT - 1, app->view.name.text);
    const char *unit;
    const bool number =
        measure_read(text, &value, &unit) &&
        (!*unit || strcmp(unit, "\xc2\xb0") == 0 || strcmp(unit, app->document.map.unit) == 0);
    if (number && s->begin) s->begin(&app->view);
    const bool done = number && s->type(app, value);
    if (number && s->end) s->end(&app->view);
    if (!done) ui_say(&app->ui, true, "%s: '%s' is no value that it can have", s->label, text);
    return done;
}

void sliders_show(app_state *app) {
    enum { COUNT = sizeof sliders / sizeof *sliders };
    _Static_assert((int)COUNT <= (int)SLIDERS_MOST, "the page has room for all");
    app->ui.slider_count = COUNT;
    for (int i = 0; i < COUNT; i++) {
        const slider_row *s = &sliders[i];
        ui_slider_row *row = &app->ui.sliders[i];
        *row = (ui_slider_row){
            .label = s->label, .help = s->help, .shown = s->shown(app), .typed = s->type != NULL};
        if (!row->shown) continue;
        row->share = s->share(app);
        s->text(app, row->text);
    }
}
