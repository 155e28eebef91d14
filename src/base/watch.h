/* Waits until one of some files changes. Whole folders are watched, for editors replace files rather than write into
 * them, and a file that is missing may appear. Linux has inotify(7) for that; elsewhere the files are looked at now and
 * then. */
#ifndef RECTRAY_WATCH_H
#define RECTRAY_WATCH_H

#include "base/error.h"

typedef struct Watch Watch;

/* NULL, with an ERROR_SYSTEM, where the system has no more to give. */
Watch *watch_open(Error *error);

/* Adds a file, which need not be there, but whose folder must; or with a path that ends in '/', all files of a folder.
 * What is watched already is not added again. */
bool watch_add(Watch *watch, const char *path, Error *error);

/* Waits for a change since the file was added or since the last wait, and then until nothing has changed for a tenth of
 * a second: a program that writes a file is left time to write it. */
bool watch_wait(Watch *watch, Error *error);

/* Frees the watch, which may be NULL. */
void watch_close(Watch *watch);

#endif
