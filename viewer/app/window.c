/// SDL's window, its density of pixels, and the loop of events.
#include "app/window.h"

#include "app/actions.h"
#include "app/frame.h"
#include "app/input.h"
#include "app/turn.h"
#include "dialogs/map_file.h"
#include "dialogs/opening.h"
#include "sightline/support.h"

#include <SDL.h>
#include <ctype.h>
#include <math.h>
#include <string.h>

struct app_window {
    app_state *app;
    SDL_Window *window;
    SDL_Renderer *renderer;
    SDL_Texture *texture;
    cairo_surface_t *surface;
    int width, height; ///< of texture and surface, pixels
    char title[TITLE_TEXT];
    bool fullscreen;
};

static sl_status fail_with(sl_context *context, const char *what) {
    return sl_fail(context, SL_IO, "%s: %s", what, SDL_GetError());
}

/// The ratio of the screen's pixels per inch to the usual 96, if it is clearly more than 1. A
/// screen that does not know its size has none, or 96 exactly: a very high one is taken as a dense
/// one.
static double density_of_screen(int screen) {
    float inch;
    SDL_Rect bounds;
    const bool told = SDL_GetDisplayDPI(screen, &inch, NULL, NULL) == 0 && fabsf(inch - 96) > 0.6F;
    if (told) return inch >= 130 && inch <= 600 ? roundf(2 * inch / 96) / 2 : 1;
    if (SDL_GetDisplayBounds(screen, &bounds) != 0) return 1;
    return fmax(floor(2 * bounds.h / 1000.0) / 2, 1);
}

/// Pixels per point of the window if the system tells the two apart; else the ratio of the screen.
static double find_density(const app_window *w) {
    int width;
    SDL_GetWindowSize(w->window, &width, NULL);
    if (width > 0 && w->width > width) return (double)w->width / width;
    return density_of_screen(SDL_GetWindowDisplayIndex(w->window));
}

/// Whether a driver of SDL's shows nothing. SDL takes such a one where it finds no display; who
/// asks for it by name gets it.
static bool is_unseen(const char *driver) {
    const char *asked = SDL_getenv("SDL_VIDEODRIVER");
    return driver && (!asked || strcmp(asked, driver) != 0) &&
           (strcmp(driver, "offscreen") == 0 || strcmp(driver, "dummy") == 0 ||
            strcmp(driver, "evdev") == 0);
}

static sl_status open_window(app_window *w, bool hidden) {
    sl_context *context = w->app->context;
    if (hidden) SDL_SetHint(SDL_HINT_VIDEODRIVER, "dummy");
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "0");
    if (SDL_Init(SDL_INIT_VIDEO) != 0) return fail_with(context, "no display");
    const char *driver = SDL_GetCurrentVideoDriver();
    if (!hidden && is_unseen(driver))
        return sl_fail(context, SL_IO,
                       "no display: neither DISPLAY nor WAYLAND_DISPLAY leads to one (--script, "
                       "--screenshot and --bench need none)");
    // X's windows are measured in pixels, whatever the screen.
    const double by = driver && strcmp(driver, "x11") == 0 ? density_of_screen(0) : 1;
    int width = (int)(by * w->app->ui.width), height = (int)(by * w->app->ui.height);
    SDL_Rect free;
    if (!hidden && SDL_GetDisplayUsableBounds(0, &free) == 0) {
        // Where it would not fit, its frame and title have some room.
        if (width > free.w) width = SDL_max(free.w - 16, 640);
        if (height > free.h) height = SDL_max(free.h - 48, 480);
    }
    w->window = SDL_CreateWindow("Sightline", SDL_WINDOWPOS_UNDEFINED, SDL_WINDOWPOS_UNDEFINED,
                                 width, height, SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI);
    if (!w->window) return fail_with(context, "no window");
    SDL_SetWindowMinimumSize(w->window, 640, 480);
    const Uint32 wanted = hidden ? SDL_RENDERER_SOFTWARE : SDL_RENDERER_PRESENTVSYNC;
    w->renderer = SDL_CreateRenderer(w->window, -1, wanted);
    if (!w->renderer) w->renderer = SDL_CreateRenderer(w->window, -1, SDL_RENDERER_SOFTWARE);
    if (!w->renderer) return fail_with(context, "no renderer");
    SDL_EventState(SDL_DROPFILE, SDL_ENABLE);
    return SL_OK;
}

// --- what cannot wait

/// Whether a key was pressed that ends jobs, or the window is to close. A picture of a large map
/// takes seconds; it is given up then, and drawn again if there is still a need.
static bool is_called_away(void *user) {
    SDL_Event events[64];
    (void)user;
    SDL_PumpEvents();
    if (SDL_HasEvent(SDL_QUIT)) return true;
    const int count = SDL_PeepEvents(events, 64, SDL_PEEKEVENT, SDL_KEYDOWN, SDL_KEYDOWN);
    for (int i = 0; i < count; i++) {
        const SDL_Keysym *key = &events[i].key.keysym;
        if (key->sym == SDLK_ESCAPE || (key->sym == SDLK_q && key->mod & (KMOD_CTRL | KMOD_GUI)))
            return true;
    }
    return false;
}

sl_status window_open(app_state *app, bool hidden, app_window **out) {
    app_window *w = sl_alloc_array(app->context, 1, sizeof *w);
    if (!w) return SL_NO_MEMORY;
    const sl_hooks hooks = {.cancelled = is_called_away};
    w->app = app;
    if (!hidden) app->view.drawing = sl_context_create(&hooks);
    const sl_status status = open_window(w, hidden);
    if (status == SL_OK)
        *out = w;
    else
        window_close(w);
    return status;
}

void window_close(app_window *w) {
    if (w->surface) cairo_surface_destroy(w->surface);
    if (w->texture) SDL_DestroyTexture(w->texture);
    if (w->renderer) SDL_DestroyRenderer(w->renderer);
    if (w->window) SDL_DestroyWindow(w->window);
    SDL_Quit();
    sl_context_destroy(w->app->view.drawing);
    w->app->view.drawing = NULL;
    sl_free(w->app->context, w);
}

/// Makes the texture as large as the window in pixels; high-density screens have more than points.
static sl_status fit_texture(app_window *w) {
    int width, height;
    if (SDL_GetRendererOutputSize(w->renderer, &width, &height) != 0)
        return fail_with(w->app->context, "no size");
    if (w->texture && width == w->width && height == w->height) return SL_OK;
    if (w->texture) SDL_DestroyTexture(w->texture);
    if (w->surface) cairo_surface_destroy(w->surface);
    w->width = width;
    w->height = height;
    w->app->ui.width = width;
    w->app->ui.height = height;
    if (!w->fullscreen) {
        w->app->ui.window_width = width;
        w->app->ui.window_height = height;
    }
    if (!w->app->ui.steady) w->app->ui.density = find_density(w);
    w->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    w->texture = SDL_CreateTexture(w->renderer, SDL_PIXELFORMAT_RGB888, SDL_TEXTUREACCESS_STREAMING,
                                   width, height);
    return w->texture ? SL_OK : fail_with(w->app->context, "no texture");
}

static void show_title(app_window *w) {
    char title[TITLE_TEXT];
    map_file_title(&w->app->desk, title);
    if (strcmp(title, w->title) == 0) return;
    memcpy(w->title, title, sizeof title);
    SDL_SetWindowTitle(w->window, title);
}

sl_status window_show(app_window *w) {
    if (w->fullscreen != w->app->ui.fullscreen) {
        w->fullscreen = w->app->ui.fullscreen;
        SDL_SetWindowFullscreen(w->window, w->fullscreen ? SDL_WINDOW_FULLSCREEN_DESKTOP : 0);
    }
    SL_TRY(fit_texture(w));
    show_title(w);
    cairo_t *cairo = cairo_create(w->surface);
    app_draw(w->app, cairo);
    cairo_destroy(cairo);
    if (w->app->view.drawing && is_called_away(w)) return SL_OK; // it may be half a picture
    cairo_surface_flush(w->surface);
    SDL_UpdateTexture(w->texture, NULL, cairo_image_surface_get_data(w->surface),
                      cairo_image_surface_get_stride(w->surface));
    SDL_RenderCopy(w->renderer, w->texture, NULL, NULL);
    SDL_RenderPresent(w->renderer);
    return SL_OK;
}

// --- events

/// The key's name as the table of actions has it: letters as capitals, '?' for itself.
static void key_name(const SDL_Keysym *sym, char name[48]) {
    const bool ctrl = sym->mod & (KMOD_CTRL | KMOD_GUI), shift = sym->mod & KMOD_SHIFT;
    const char *plain = SDL_GetKeyName(sym->sym);
    if (shift && sym->sym == SDLK_SLASH) plain = "?";
    if (sym->sym == SDLK_QUESTION) plain = "?";
    if (sym->sym == SDLK_PLUS || sym->sym == SDLK_KP_PLUS) plain = "=";
    if (sym->sym == SDLK_KP_MINUS) plain = "-";
    if (sym->sym == SDLK_KP_ENTER) plain = "Return";
    // With other keys the shift is a part of what they type.
    const bool letter = sym->sym >= SDLK_a && sym->sym <= SDLK_z;
    const bool with_shift =
        shift && ((ctrl && letter) || sym->sym == SDLK_TAB || sym->sym == SDLK_RETURN ||
                  sym->sym == SDLK_LEFT || sym->sym == SDLK_RIGHT || sym->sym == SDLK_UP ||
                  sym->sym == SDLK_DOWN);
    snprintf(name, 48, "%s%s%s", ctrl ? "Ctrl+" : "", with_shift ? "Shift+" : "", plain);
}

/// From window coordinates to pixels.
static sl_point to_pixels(const app_window *w, int x, int y) {
    int width, height;
    SDL_GetWindowSize(w->window, &width, &height);
    return (sl_point){(double)x * w->width / (width > 0 ? width : 1),
                      (double)y * w->height / (height > 0 ? height : 1)};
}

static void take_button(app_window *w, const SDL_MouseButtonEvent *e) {
    const sl_point at = to_pixels(w, e->x, e->y);
    if (e->type == SDL_MOUSEBUTTONUP) {
        input_release(w->app, at);
        return;
    }
    input_press(w->app,
                e->button == SDL_BUTTON_RIGHT    ? BUTTON_RIGHT
                : e->button == SDL_BUTTON_MIDDLE ? BUTTON_MIDDLE
                                                 : BUTTON_LEFT,
                at);
}

static void paste_text(app_state *app) {
    char *text = SDL_GetClipboardText();
    if (text) input_text(app, text);
    SDL_free(text);
}

static void take_event(app_window *w, const SDL_Event *e) {
    char name[48];
    switch (e->type) {
    case SDL_QUIT:
        action_run(w->app, action_find("quit"));
        break;
    case SDL_KEYDOWN:
    case SDL_KEYUP:
        key_name(&e->key.keysym, name);
        if (e->type == SDL_KEYDOWN && strcmp(name, "Ctrl+V") == 0) paste_text(w->app);
        input_key(w->app, name, e->type == SDL_KEYDOWN);
        break;
    case SDL_TEXTINPUT:
        input_text(w->app, e->text.text);
        break;
    case SDL_MOUSEBUTTONDOWN:
    case SDL_MOUSEBUTTONUP:
        take_button(w, &e->button);
        break;
    case SDL_MOUSEMOTION:
        input_move(w->app, to_pixels(w, e->motion.x, e->motion.y));
        break;
    case SDL_MOUSEWHEEL:
        input_wheel(w->app, e->wheel.y);
        break;
    case SDL_DROPFILE:
        files_drop(&w->app->desk, e->drop.file);
        SDL_free(e->drop.file);
        break;
    case SDL_WINDOWEVENT:
        if (e->window.event == SDL_WINDOWEVENT_FOCUS_LOST) w->app->view.held = 0;
        break;
    default:
        break;
    }
}

/// Whether something moves without input.
static bool is_lively(const app_state *app) {
    return app->view.held || app->document.job || app_progress(app).running ||
           app->recorder.plays || app->recorder.records || app->learn.lesson.plays ||
           app->view.motion > 0;
}

sl_status window_run(app_window *w) {
    app_state *app = w->app;
    double last = sl_seconds();
    while (!app->desk.quit) {
        SDL_Event event;
        // Nothing is drawn again while nothing happens.
        const bool any = is_lively(app) ? SDL_PollEvent(&event) : SDL_WaitEventTimeout(&event, 250);
        bool more = any;
        for (bool stale = false; more; stale = true, more = SDL_PollEvent(&event)) {
            // A click meant what is there after the key before it, and a key the dialog that opens.
            if ((stale && event.type == SDL_MOUSEBUTTONDOWN) || dialog_is_unseen(&app->desk.dialog))
                SL_TRY(window_show(w));
            take_event(w, &event);
        }
        if (app->desk.quit) break;
        const double now = sl_seconds();
        const bool lively = is_lively(app);
        app_tick(app, lively ? now - last : 0);
        if (!lively) ui_tick(&app->ui, now - last);
        last = now;
        SL_TRY(window_show(w));
        const double spent = sl_seconds() - now;
        app->ui.frame_seconds =
            app->ui.frame_seconds > 0 ? 0.9 * app->ui.frame_seconds + 0.1 * spent : spent;
        // Where the display does not make us wait for it, we wait ourselves.
        if (lively && spent < 0.004) SDL_Delay((Uint32)((0.0155 - spent) * 1000));
    }
    return SL_OK;
}
