/* Target: --set, from the option's value to the scene. */
#include "fuzz.h"

#include "command/scene_open.h"
#include "json/json_edit.h"
#include "json/json_scan.h"

#include <stdlib.h>
#include <string.h>

static const char SCENE[] =
    "{\"camera\": {\"position\": [0.5, 0.5, 1], \"look_at\": [0.5, 0.5, 0]}, \"screen\": {\"columns\": 8, \"rows\": 6},"
    " \"lights\": [{\"position\": [0, 0, 5]}], \"materials\": {\"light grey\": {\"diffuse\": [0.7, 0.7, 0.7]}},"
    " \"objects\": [{\"material\": \"light grey\", \"vertices\": [[0, 0, 0], [1, 0, 0], [1, 1, 0]],"
    " \"faces\": [[0, 1, 2]]}]}";

long fuzz_edit_refused;

/* An edit of a JSON text is a JSON text, if it is not too deep. The same edit changes nothing more in it, unless its
 * value has blanks. */
static void check_edit(const char *text, char *line)
{
    static Error error;
    char *value = strchr(line, '=');
    if (!value || json_scan(text, (long)strlen(text)).place)
        return;
    *value++ = '\0';
    error.kind = ERROR_NONE;
    char *once = json_edit(text, line, value, &error);
    REQUIRE((once == NULL) == (error.kind != ERROR_NONE));
    if (!once)
        return;
    JsonFault fault = json_scan(once, (long)strlen(once));
    REQUIRE(!fault.place || strstr(fault.reason, "deep"));
    char *twice = fault.place ? NULL : json_edit(once, line, value, &error);
    bool is_tight = value[0] && value[strcspn(value, " \t\r")] == '\0';
    REQUIRE(fault.place || (twice && (!is_tight || strcmp(once, twice) == 0)));
    free(once);
    free(twice);
}

/* Splits the lines into values of --set. Returns their number, at most `max`. */
static int split(char *lines, OptionEdit *edits, int max)
{
    int count = 0;
    for (char *line = strtok(lines, "\n"); line && count < max; line = strtok(NULL, "\n"))
        edits[count++] = (OptionEdit){"set", line};
    return count;
}

int fuzz_edit(const uint8_t *data, size_t size)
{
    static Error error;
    static Options options;
    const uint8_t *begin = data;
    size_t length = fuzz_cut(&data, &size);
    char *lines = malloc(length + 1), *text = malloc(size + sizeof SCENE);
    REQUIRE(lines && text);
    memcpy(lines, begin, length);
    lines[length] = '\0';
    memcpy(text, size ? (const char *)data : SCENE, size ? size : sizeof SCENE);
    text[size ? size : sizeof SCENE - 1] = '\0';

    const char *scene_file = fuzz_file(FUZZ_MODEL, (const uint8_t *)text, strlen(text));
    options = (Options){.quiet = true, .operands = &scene_file, .operand_count = 1};
    options.edit_count = split(lines, options.edits, EDITS_MAX);
    Scene scene;
    error.kind = ERROR_NONE;
    error.text[0] = '\0';
    if (scene_open(&scene, &options, &error)) {
        REQUIRE(error.kind == ERROR_NONE);
        fuzz_check_scene(&scene);
        scene_free(&scene);
    } else {
        fuzz_edit_refused++;
        fuzz_check_error(&error);
        REQUIRE(error.kind != ERROR_USAGE || strncmp(error.text, "--set ", 6) == 0);
    }
    for (int i = 0; i < options.edit_count; i++)
        check_edit(text, (char *)(uintptr_t)options.edits[i].value);
    free(lines);
    free(text);
    return 0;
}
