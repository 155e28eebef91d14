/* Sentences that several formats of the walkthrough say in the same words. */
#ifndef RECTRAY_WALKTHROUGH_WORDS_H
#define RECTRAY_WALKTHROUGH_WORDS_H

#include "walkthrough/ink.h"
#include "walkthrough/walkthrough.h"

/* "floor", or "house: roof" where the face belongs to a part of the object. */
InkText walkthrough_owner_words(const Scene *scene, int face, int columns);

/* "floor/2", "house: roof/17": the same, and the face's number in the object. */
InkText walkthrough_face_words(const Scene *scene, int face, int columns);

/* Whether a light reaches the latest hit, or what keeps it away. `place` stands at the EVENT_LIGHT_END. */
InkText walkthrough_light_words(const Walkthrough *walk, const WalkthroughPlace *place, const Event *light_end);

/* Why the path ended: the reason alone, and as a sentence. `place` stands at the EVENT_PATH_END. */
InkText walkthrough_reason_words(const Walkthrough *walk, const WalkthroughPlace *place, const Event *path_end);
InkText walkthrough_end_words(const Walkthrough *walk, const WalkthroughPlace *place, const Event *path_end);

/* "Pixel (3, 2) = (97, 74, 97)", of an EVENT_PIXEL. */
InkText walkthrough_pixel_words(const Walkthrough *walk, const Event *pixel);

#endif
