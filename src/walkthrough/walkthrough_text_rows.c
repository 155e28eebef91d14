/* What all parts of the walkthrough as text share. */
#include "walkthrough/walkthrough_text_rows.h"

#include <string.h>

void walkthrough_text_step(WalkthroughText *text, const char *title)
{
    ink_heading(&text->ink, "Step %d. %s", ++text->step, title);
}

InkRow walkthrough_text_place_row(const WalkthroughText *text, InkText label, Vec3 position)
{
    return (InkRow){.label = label, .v = walkthrough_world(text->walk->scene, position), .digits = text->digits};
}

InkText walkthrough_text_face(const Scene *scene, int face, int columns)
{
    InkText number = ink_text("/%d", walkthrough_face_in_object(scene, face));
    int room = columns - (int)strlen(number.text);
    return ink_text("%.64s%s", ink_name(scene->objects[scene->faces[face].object].name, room).text, number.text);
}
