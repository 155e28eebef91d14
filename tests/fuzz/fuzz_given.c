/* Target: the reader of walkthroughs to be graded, and the grading of what it accepts. */
#include "fuzz.h"

#include "grade/grade.h"
#include "reader/scene_json.h"

#include <string.h>

/* A mirror before a wall, lit by one light. */
static const char SCENE[] =
    "{\"camera\":{\"position\":[0,0,5],\"look_at\":[0,0,0]},\"screen\":{\"columns\":4,\"rows\":3},"
    "\"lights\":[{\"position\":[1,2,4]}],"
    "\"materials\":{\"m\":{\"diffuse\":[0.5,0.5,0.5],\"reflection\":0.5}},"
    "\"objects\":[{\"name\":\"a\",\"material\":\"m\",\"box\":{\"min\":[-1,-1,-1],\"max\":[1,1,1]}},"
    "{\"name\":\"b\",\"material\":\"m\",\"box\":{\"min\":[-9,-9,8],\"max\":[9,9,9]}}]}";

static const Scene *the_scene(void)
{
    static Scene scene;
    Error error = {.kind = ERROR_NONE};
    if (scene.face_count == 0)
        REQUIRE(scene_parse(&scene, "scene.json", SCENE, (long)sizeof SCENE - 1, &error));
    return &scene;
}

int fuzz_given(const uint8_t *data, size_t size)
{
    static Error error;
    Given given;
    Grade grade = {.given = NULL};
    error.kind = ERROR_NONE;
    error.text[0] = '\0';
    if (given_parse(&given, "given.json", (const char *)data, (long)size, &error)) {
        WalkthroughRequest request = {.column = given.column % 4, .row = given.row % 3};
        Tolerance tolerance = {GRADE_ABSOLUTE, GRADE_RELATIVE};
        if (!grade_make(&grade, the_scene(), "scene.json", &given, request, tolerance, &error))
            fuzz_check_error(&error);
        else
            REQUIRE(error.kind == ERROR_NONE && (grade.same || grade.difference.kind != DIFFERENCE_NONE));
        grade_free(&grade);
    } else {
        fuzz_check_error(&error);
        REQUIRE(!given.events && given.count == 0);
    }
    given_free(&given);
    return 0;
}
