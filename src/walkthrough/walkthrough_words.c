/* Sentences that several formats of the walkthrough say in the same words. */
#include "walkthrough/walkthrough_words.h"

#include <string.h>

InkText walkthrough_owner_words(const Scene *scene, int face, int columns)
{
    const char *object = scene->objects[scene->faces[face].object].name, *part = scene_part_of(scene, face);
    if (!part)
        return ink_name(object, columns);
    InkText whole = ink_name(part, 60);
    int room = columns - 2 - ink_width(whole.text);
    if (room < columns / 3) { /* the longer one is cut, both where both are long */
        room = columns / 3;
        whole = ink_name(part, columns - 2 - room);
    }
    return ink_text("%s: %s", ink_name(object, room).text, whole.text);
}

InkText walkthrough_face_words(const Scene *scene, int face, int columns)
{
    InkText number = ink_text("/%d", walkthrough_face_in_object(scene, face));
    int room = columns - (int)strlen(number.text);
    return ink_text("%s%s", walkthrough_owner_words(scene, face, room).text, number.text);
}

InkText walkthrough_light_words(const Walkthrough *walk, const WalkthroughPlace *place, const Event *light_end)
{
    int number = walkthrough_hit_number(place), face = light_end->as.light_end.blocker;
    switch (light_end->as.light_end.verdict) {
    case LIGHT_REACHES:
        return ink_text("Nothing is in the way: light %d reaches P%d.", light_end->as.light_end.light, number);
    case LIGHT_BLOCKED:
        return ink_text("Face %d, %s, is in the way: P%d is in its shadow.", walk->scene->faces[face].number,
                        walkthrough_face_words(walk->scene, face, 40).text, number);
    default:
        return ink_text("The light is %s: it cannot reach P%d. No ray is needed.",
                        place->light->as.light.side < 0 ? "behind the face" : "in the face's own plane", number);
    }
}

InkText walkthrough_reason_words(const Walkthrough *walk, const WalkthroughPlace *place, const Event *path_end)
{
    int number = walkthrough_hit_number(place);
    switch (path_end->as.path_end.reason) {
    case PATH_IN_SHADOW:
        return ink_text("no light reaches P%d, and \"shadow\" is \"black\"", number);
    case PATH_NOT_MIRROR:
        return ink_text("the material at P%d has reflection 0", number);
    case PATH_MAX_BOUNCES:
        return ink_text("it was reflected max_bounces = %d times", walk->scene->shading.max_bounces);
    default:
        return ink_text("the ray met no face");
    }
}

InkText walkthrough_end_words(const Walkthrough *walk, const WalkthroughPlace *place, const Event *path_end)
{
    return ink_text("The path ended here: %s.", walkthrough_reason_words(walk, place, path_end).text);
}

InkText walkthrough_pixel_words(const Walkthrough *walk, const Event *pixel)
{
    const unsigned char *rgb = pixel->as.pixel.rgb;
    return ink_text("Pixel (%d, %d) = (%d, %d, %d)", walk->request.column, walk->request.row, rgb[0], rgb[1], rgb[2]);
}
