/* What a scene is: camera, screen, lights, materials, objects and the faces that are traced.
 * Readers fill a Scene (scene_json.h), the tracers only read it. Positions here are relative to the scene's
 * centre (see scene_centre); colours are RGB in x, y, z. */
#ifndef RECTRAY_SCENE_H
#define RECTRAY_SCENE_H

#include "base/error.h"
#include "base/notes.h"
#include "base/vec3.h"

#include <stdbool.h>

enum {
    SCENE_MAX_PIXELS = 16384, /* columns, rows */
    SCENE_MAX_BOUNCES = 64,
    SCENE_MAX_GRID = 16,
    SCENE_ADAPTIVE_GRID = 8, /* where adaptive sampling is asked for without a number */
};

/* Colours may exceed 1, but the product of two of them must stay within a float. */
#define SCENE_MAX_COLOUR 1e18
#define SCENE_MAX_SHININESS 1e18

/* How far textbook arithmetic shifts a point off its face: unless told otherwise, and at most. */
#define SCENE_SHIFT 1e-5f
#define SCENE_MAX_SHIFT 1e6

typedef struct Camera {
    Vec3 position;
    Vec3 look_at;
    Vec3 up;
} Camera;

typedef struct Screen {
    int columns, rows;
    double distance, width;
    double height; /* 0: square pixels, see screen_height */
} Screen;

typedef struct Light {
    Vec3 position;
    Vec3 ambient, diffuse, specular;
} Light;

typedef struct Material {
    char *name;
    Vec3 ambient, diffuse, specular;
    double shininess;  /* alpha >= 0 */
    double reflection; /* 0..1 */
} Material;

typedef struct Object {
    char *name;     /* never NULL: an unnamed object is "objects[INDEX]" */
    int first_face; /* index into Scene.faces */
    int face_count;
    int first_number; /* of its faces in the file; that one may have been left out */
} Object;

/* A named part of a model: the faces from first_face to the next part, or to the end of the object. */
typedef struct ScenePart {
    char *name; /* "": the faces have the object's name only */
    int first_face;
} ScenePart;

/* A face as traced: 3 or 4 vertices, relative to the scene's centre, rounded once to float32. */
typedef struct Face {
    float vertices[4][3];        /* a triangle repeats its vertex 0 in row 3 */
    int number;                  /* the face's number in the file, from 0; the triangles of a split face share it */
    int object;                  /* index into Scene.objects */
    int material;                /* index into Scene.materials */
    unsigned short vertex_count; /* 3 or 4 */
    unsigned short one_sided;    /* 1: rays that come from behind the normal pass through */
} Face;

/* The plane A x + B y + C z + D = 0 of a face, with the unit normal N = (A, B, C); see face_plane. */
typedef struct Plane {
    Vec3 normal;
    Vec3 normal_low; /* what rounding took from the normal: N + normal_low has twice its precision */
    double d;
    double error;  /* no component of the exact normal is farther than this from N + normal_low */
    double length; /* of the cross product of the diagonals: det(x, v2 - v0, v3 - v1) = length (N + normal_low).x */
} Plane;

typedef enum ShadowRule { SHADOW_BLACK, SHADOW_AMBIENT } ShadowRule;
typedef enum ViewerRule { VIEWER_CAMERA, VIEWER_RAY } ViewerRule;

/* What a scene file calls them. */
extern const char *const scene_shadow_rules[], *const scene_viewer_rules[];

typedef struct Shading {
    ShadowRule shadow;
    ViewerRule viewer;
    int max_bounces;
    Vec3 background;
} Shading;

typedef struct Scene {
    Camera camera;
    Screen screen;
    Light *lights;
    int light_count;
    Material *materials;
    int material_count;
    Object *objects;
    int object_count;
    ScenePart *parts; /* in the order of their faces */
    int part_count;
    Face *faces;
    int face_count; /* faces as traced: a split face counts twice */
    Plane *planes;  /* one per face */
    Vec3 centre;    /* world position = scene position + centre */
    Shading shading;
    int grid;      /* n x n rays per pixel, */
    bool adaptive; /* or, where one ray through its centre is enough for a pixel, that ray alone: adaptive.h */
    Notes notes;   /* what its readers had to say */
} Scene;

/* Frees all that the scene owns and zeroes it; a zeroed scene may be freed again. */
void scene_free(Scene *scene);

/* The name of the part that a face belongs to; NULL where it is in none. */
const char *scene_part_of(const Scene *scene, int face);

/* The screen's height: as given, or width * rows / columns when the pixels are square. */
double screen_height(const Screen *screen);

/* The centre to trace a scene around: the middle of the bounding box [low, high] of its vertices (of the camera,
 * where there is no face), rounded to a multiple of a power of two about 1/1024 of the box's size, so that a scene
 * and its translated copy get the same relative coordinates. */
Vec3 scene_centre(Vec3 low, Vec3 high);

#endif
