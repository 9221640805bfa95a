/// The dialog that opens and saves files: a field for the path, with completion by Tab, and a list
/// of the folder, of the files opened last, or of the samples.
#ifndef VIEWER_BROWSER_H
#define VIEWER_BROWSER_H

#include "app/app.h"

void browser_open(app_state *app);
/// Asks for the name to save the map under.
void browser_save(app_state *app);
/// The same with this path in the field.
void browser_save_to(app_state *app, const char *path);

void browser_draw(app_state *app);
void browser_act(app_state *app, int id);
void browser_edited(app_state *app, int id);
bool browser_key(app_state *app, const char *key);
void browser_destroy(app_state *app);

#endif
