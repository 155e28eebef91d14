/* What the fuzzers try. A target takes any bytes as its input and ends the program where the code under test breaks a
 * promise; the sanitizers watch the rest. `make fuzz` makes libFuzzer programs of them, tests/test_fuzz.c runs them
 * over the inputs kept in tests/fuzz/NAME/. To add one: its function here, fuzz_NAME.c, the folder tests/fuzz/NAME, its
 * name in FUZZ_TARGETS. */
#ifndef RECTRAY_TESTS_FUZZ_H
#define RECTRAY_TESTS_FUZZ_H

#include "scene/scene.h"

#include <stddef.h>
#include <stdint.h>

#define FUZZ_TARGETS(X) X(scene) X(obj) X(mtl) X(model) X(options) X(edit) X(given)

/* A scene file; then, after lines of "---", the model "100" and the library "101" that it may name. */
int fuzz_scene(const uint8_t *data, size_t size);

/* A model; after a line of "---" the library "101" that it may name. */
int fuzz_obj(const uint8_t *data, size_t size);

/* A model: OBJ, PLY or STL. */
int fuzz_model(const uint8_t *data, size_t size);

/* A material library. */
int fuzz_mtl(const uint8_t *data, size_t size);

/* A walkthrough to be graded. */
int fuzz_given(const uint8_t *data, size_t size);

/* A command line, a word in each line; the first is the command. */
int fuzz_options(const uint8_t *data, size_t size);

/* Values of --set, one in each line; after a line of "---" the scene, a small one where there is none. */
int fuzz_edit(const uint8_t *data, size_t size);
extern long fuzz_edit_refused; /* inputs of fuzz_edit so far that were refused */

/* --- What the targets share --- */

/* Says which promise is broken, and aborts. */
#define REQUIRE(promise) ((promise) ? (void)0 : fuzz_broken(#promise, __FILE__, __LINE__))
void fuzz_broken(const char *promise, const char *file, int line);

/* A file without a name, but with a path: /proc/self/fd/NUMBER. It is there until the next call for that number. */
enum { FUZZ_MODEL = 100, FUZZ_LIBRARY = 101 };
const char *fuzz_file(int number, const uint8_t *data, size_t size);

/* Cuts the bytes before the next line "---" off the data, all where there is none. Returns their number. */
size_t fuzz_cut(const uint8_t **data, size_t *size);

/* A failure has a kind and one message, without control characters. */
void fuzz_check_error(const Error *error);

/* What every loaded scene promises its tracers; and that both trees lead a few rays to the same faces as none does. */
void fuzz_check_scene(const Scene *scene);

#endif
