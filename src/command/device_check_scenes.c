/* Two scenes: a room in which every term of the shading counts, and boxes enough for a tree. */
#include "command/device_check_scenes.h"

#include <stddef.h>

#define LIGHT(x, y, z)                                                                                     \
    "{\"position\": [" #x ", " #y ", " #z "], \"ambient\": [0.1, 0.1, 0.1], \"diffuse\": [0.6, 0.5, 0.4]," \
    " \"specular\": [0.5, 0.5, 0.5]}"

#define BOX(material, x, z, x_most, high, z_most)                                                            \
    "{\"material\": \"" material "\", \"box\": {\"min\": [" #x ", 0, " #z "], \"max\": [" #x_most ", " #high \
    ", " #z_most "]}}, "

/* Shadows of two lights, mirrors that face each other, a tilted box, highlights, faces seen from one side. */
static const char room[] =
    "{\"camera\": {\"position\": [0.3, 1.6, 4.5], \"look_at\": [0, 1, 0], \"up\": [0, 1, 0]},"
    " \"screen\": {\"columns\": 64, \"rows\": 48, \"distance\": 1, \"width\": 1.3},"
    " \"lights\": [" LIGHT(1.5, 2.6, 2) ", " LIGHT(
        -1.6, 2.2,
        1) "],"
           " \"materials\": {"
           "  \"wall\": {\"ambient\": [0.5, 0.5, 0.5], \"diffuse\": [0.8, 0.7, 0.6]},"
           "  \"mirror\": {\"diffuse\": [0.1, 0.1, 0.2], \"specular\": [0.5, 0.5, 0.5], \"shininess\": 60,"
           "               \"reflection\": 0.7},"
           "  \"box\": {\"ambient\": [0.3, 0.5, 0.9], \"diffuse\": [0.2, 0.4, 0.8], \"specular\": [0.6, 0.6, 0.6],"
           "            \"shininess\": 25}},"
           " \"objects\": ["
           "  {\"material\": \"wall\", \"vertices\": [[-2, 0, -2], [-2, 0, 3], [2, 0, 3], [2, 0, -2], [-2, 3, -2],"
           "   [2, 3, -2]], \"faces\": [[0, 1, 2, 3], [0, 3, 5, 4]]},"
           "  {\"material\": \"mirror\", \"sided\": \"front\", \"vertices\": [[-2, 0, -2], [-2, 0, 3], [-2, 3, 3],"
           "   [-2, 3, -2], [2, 0, -2], [2, 0, 3], [2, 3, 3], [2, 3, -2]], \"faces\": [[0, 3, 2, 1], [4, 5, 6, 7]]},"
           "  {\"material\": \"box\", \"box\": {\"min\": [-0.6, 0.2, -0.7], \"max\": [0.5, 1.3, 0.4]},"
           "   \"transform\": [{\"rotate\": {\"axis\": [1, 2, 0.5], \"degrees\": 31}}]}],"
           " \"shading\": {\"shadow\": \"ambient\", \"max_bounces\": 4, \"background\": [0.1, 0.2, 0.4]}}";

/* A hundred faces in a tree, their shadows, and the sky. */
/* clang-format off */
static const char boxes[] =
    "{\"camera\": {\"position\": [7, 6, 9], \"look_at\": [0, 0, 0], \"up\": [0, 1, 0]},"
    " \"screen\": {\"columns\": 64, \"rows\": 48, \"distance\": 1, \"width\": 1},"
    " \"lights\": [" LIGHT(3, 9, 5) ", " LIGHT(-6, 4, 1) "],"
    " \"materials\": {"
    "  \"red\": {\"ambient\": [0.5, 0.3, 0.2], \"diffuse\": [0.9, 0.4, 0.3], \"reflection\": 0.2},"
    "  \"blue\": {\"ambient\": [0.2, 0.3, 0.5], \"diffuse\": [0.3, 0.4, 0.9], \"specular\": [0.7, 0.7, 0.7],"
    "             \"shininess\": 12}},"
    " \"objects\": ["
    BOX("blue", -4, -4, -2.75, 1, -2.75) BOX("blue", -2, -4, -0.75, 0.5, -2.75)
    BOX("red", 0, -4, 1.25, 2, -2.75) BOX("red", 2, -4, 3.25, 0.5, -2.75)
    BOX("blue", -4, -2, -2.75, 0.25, -0.75) BOX("blue", -2, -2, -0.75, 2.25, -0.75)
    BOX("red", 0, -2, 1.25, 0.25, -0.75) BOX("blue", 2, -2, 3.25, 2.25, -0.75)
    BOX("red", -4, 0, -2.75, 1.25, 1.25) BOX("blue", -2, 0, -0.75, 0.5, 1.25)
    BOX("red", 0, 0, 1.25, 1, 1.25) BOX("blue", 2, 0, 3.25, 1.25, 1.25)
    BOX("red", -4, 2, -2.75, 1, 3.25) BOX("blue", -2, 2, -0.75, 1.25, 3.25)
    BOX("red", 0, 2, 1.25, 1.5, 3.25) BOX("blue", 2, 2, 3.25, 1.5, 3.25)
    "  {\"material\": \"red\", \"vertices\": [[-6, 0, -6], [-6, 0, 6], [6, 0, 6], [6, 0, -6]],"
    "   \"faces\": [[0, 1, 2, 3]]}],"
    " \"shading\": {\"shadow\": \"ambient\", \"background\": [0.5, 0.6, 0.8]}}";
/* clang-format on */

const DeviceCheckScene device_check_scenes[] = {
    {"room", room, ACCEL_NONE},
    {"boxes", boxes, ACCEL_BVH},
    {0},
};
