/* The files of frames: 'frame-%04d.png' stands for frame-0000.png, frame-0001.png and so on. */
#ifndef RECTRAY_FRAME_NAMES_H
#define RECTRAY_FRAME_NAMES_H

#include "base/error.h"

/* Whether a pattern names a file for each frame: one %d, or %03d and its like, in which digits and zeros are allowed,
 * and %% for a percent sign. Else false, with an ERROR_USAGE that says what is wrong. */
bool frame_names_check(const char *pattern, Error *error);

/* The file of a frame, by a pattern that is right. The caller frees it; NULL without memory. */
char *frame_name(const char *pattern, int frame, Error *error);

#endif
