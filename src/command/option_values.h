/* The words and the functions by which the table of options reads what is no plain text or number. A function is given
 * the value, and NULL where there may be none and is none; false says that it is not a proper one. */
#ifndef RECTRAY_OPTION_VALUES_H
#define RECTRAY_OPTION_VALUES_H

#include "command/option.h"

/* Each list ends in a NULL. */
extern const char *const option_progress_modes[], *const option_colour_choices[], *const option_stats_formats[];
extern const char *const option_help_formats[], *const option_depth_words[], *const option_lane_words[];

bool option_set_size(Options *o, const char *value);
bool option_set_grid(Options *o, const char *value);
bool option_set_sampling(Options *o, const char *value);
bool option_set_map(Options *o, const char *value);
bool option_set_region(Options *o, const char *value);
bool option_set_part(Options *o, const char *value);
bool option_set_mark(Options *o, const char *value);
bool option_set_map_scale(Options *o, const char *value);
bool option_set_camera(Options *o, const char *value);
bool option_set_look_at(Options *o, const char *value);
bool option_set_up(Options *o, const char *value);
bool option_set_light(Options *o, const char *value);
bool option_set_value(Options *o, const char *value);
bool option_set_frame(Options *o, const char *value);
bool option_set_frames(Options *o, const char *value);
bool option_set_pixel(Options *o, const char *value);
bool option_set_sample(Options *o, const char *value);
bool option_set_precision(Options *o, const char *value);
bool option_set_shift(Options *o, const char *value);
bool option_set_tolerance(Options *o, const char *value);
bool option_set_lanes(Options *o, const char *value);
bool option_set_no_skip(Options *o, const char *value);
bool option_set_stats(Options *o, const char *value);

#endif
