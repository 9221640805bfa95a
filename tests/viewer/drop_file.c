/// drop_file WINDOW FILE: drops a file on a window as a file manager does (XDND version 5), and
/// waits until it was taken. Directed portals 0 then, 1 where it was not within ten seconds.
#include <X11/Xatom.h>
#include <X11/Xlib.h>

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { VERSION = 5, PATIENCE = 10 };

typedef struct source {
    Display *display;
    Window window, target;
    Atom enter, position, status, drop, finished, selection, uri_list, copy;
    char uri[4200];
} source;

static Atom atom(const source *s, const char *name) {
    return XInternAtom(s->display, name, False);
}

static void send(const source *s, Atom type, long a, long b, long c, long d) {
    XEvent event = {.xclient = {.type = ClientMessage,
                                .display = s->display,
                                .window = s->target,
                                .message_type = type,
                                .format = 32,
                                .data.l = {(long)s->window, a, b, c, d}}};
    XSendEvent(s->display, s->target, False, NoEventMask, &event);
    XFlush(s->display);
}

/// Hands over the name of what is dropped.
static void answer(const source *s, const XSelectionRequestEvent *asked) {
    XEvent reply = {.xselection = {.type = SelectionNotify,
                                   .display = s->display,
                                   .requestor = asked->requestor,
                                   .selection = asked->selection,
                                   .target = asked->target,
                                   .property = asked->property,
                                   .time = asked->time}};
    XChangeProperty(s->display, asked->requestor, asked->property, s->uri_list, 8, PropModeReplace,
                    (const unsigned char *)s->uri, (int)strlen(s->uri));
    XSendEvent(s->display, asked->requestor, False, NoEventMask, &reply);
    XFlush(s->display);
}

/// Whether the target is through with it.
static bool take_event(const source *s, const XEvent *event) {
    if (event->type == SelectionRequest) answer(s, &event->xselectionrequest);
    if (event->type != ClientMessage) return false;
    if (event->xclient.message_type == s->status) send(s, s->drop, 0, CurrentTime, 0, 0);
    return event->xclient.message_type == s->finished;
}

static bool drop(const source *s) {
    XSetSelectionOwner(s->display, s->selection, s->window, CurrentTime);
    send(s, s->enter, (long)VERSION << 24, (long)s->uri_list, 0, 0);
    send(s, s->position, 0, 400L << 16 | 300, CurrentTime, (long)s->copy);
    const time_t end = time(NULL) + PATIENCE;
    while (time(NULL) < end) {
        while (XPending(s->display)) {
            XEvent event;
            XNextEvent(s->display, &event);
            if (take_event(s, &event)) return true;
        }
        const struct timespec pause = {0, 5000000};
        nanosleep(&pause, NULL);
    }
    return false;
}

int main(int argc, char **argv) {
    source s = {.display = XOpenDisplay(NULL)};
    if (argc != 3 || !s.display) {
        fputs("usage: drop_file WINDOW FILE, on a display\n", stderr);
        return 2;
    }
    s.target = strtoul(argv[1], NULL, 0);
    snprintf(s.uri, sizeof s.uri, "file://%s\r\n", argv[2]);
    s.window = XCreateSimpleWindow(s.display, DefaultRootWindow(s.display), 0, 0, 1, 1, 0, 0, 0);
    s.enter = atom(&s, "XdndEnter");
    s.position = atom(&s, "XdndPosition");
    s.status = atom(&s, "XdndStatus");
    s.drop = atom(&s, "XdndDrop");
    s.finished = atom(&s, "XdndFinished");
    s.selection = atom(&s, "XdndSelection");
    s.uri_list = atom(&s, "text/uri-list");
    s.copy = atom(&s, "XdndActionCopy");
    const bool taken = drop(&s);
    XCloseDisplay(s.display);
    if (!taken) fputs("drop_file: nothing took the file\n", stderr);
    return taken ? 0 : 1;
}
