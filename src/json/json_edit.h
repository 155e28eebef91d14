/* Changing single values of a JSON text: the text is what a file would be in which somebody had typed the change. */
#ifndef RECTRAY_JSON_EDIT_H
#define RECTRAY_JSON_EDIT_H

#include "base/error.h"

/* Puts a value where a path leads: camera.position[0], materials["light grey"].diffuse.
 *   text     a JSON text that ends in a NUL; it is not checked
 *   value    a JSON value; what is none is taken for a word, and gets quotes
 * A key that an object lacks is added to it, with objects for the keys that follow it. Returns the new text, which the
 * caller frees; NULL with an ERROR_USAGE that tells how far the path leads, or without memory. */
char *json_edit(const char *text, const char *path, const char *value, Error *error);

/* Whether the outermost object of a text has a key; the text need not be JSON. */
bool json_has(const char *text, const char *word);

/* A copy of a JSON text without a member of its outermost object, and without the comma that it leaves. NULL without
 * memory. */
char *json_without(const char *text, const char *word);

#endif
