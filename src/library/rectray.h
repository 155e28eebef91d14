/* rectray as a library: scenes from files or text, pictures into memory, rays, and the walkthrough of a pixel as JSON.
 * No function has state of its own: what is told is told through the error, and scenes may be used by several threads,
 * each scene by any number of them at once, while none frees it. docs/library.md has examples in C and Python. */
#ifndef RECTRAY_RECTRAY_H
#define RECTRAY_RECTRAY_H

#ifdef __cplusplus
extern "C" {
#endif
#ifdef __GNUC__
#pragma GCC visibility push(default) /* the only names that a shared library shows */
#endif

#define RECTRAY_API_VERSION 1

/* A scene that is read: faces, lights, camera. */
typedef struct RectrayScene RectrayScene;

/* What went wrong, where a function returns 0 or NULL. `kind`: 1 the scene or its models, with "PATH:LINE:COLUMN: ..."
 * in the text; 2 an argument; 3 the device, memory or the file system. Begin with an error that is all zero. */
typedef struct RectrayError {
    int kind;
    char text[8192];
} RectrayError;

typedef struct RectraySettings {
    int reference; /* 0: OpenCL, 1: the reference tracer in C, in double */
    int in_double; /* of OpenCL: 0: float, 1: double */
    int threads;   /* 0: one per processor */
    int device;    /* 0: the default, else 1 + the number that `rectray devices` shows */
} RectraySettings;

/* Reads a scene file and its models. */
RectrayScene *rectray_scene_load(const char *path, RectrayError *error);

/* The same for a text. `name` stands for its path in messages, and models are looked for beside it. */
RectrayScene *rectray_scene_parse(const char *name, const char *text, long length, RectrayError *error);

void rectray_scene_free(RectrayScene *scene);

/* The picture's size in pixels. A new one is 1 to 16384 on a side; 0 is returned for another. */
void rectray_scene_size(const RectrayScene *scene, int *columns, int *rows);
int rectray_scene_resize(RectrayScene *scene, int columns, int rows);

/* Receives `rows` rows of the picture from `first_row` on, the top one first: 3 * columns bytes each, red, green, blue.
 * Returns 0 to stop. */
typedef int (*RectrayBand)(void *user, int first_row, int rows, const unsigned char *rgb);

/* Renders the picture, band after band. Settings that are NULL are all 0. Returns 1, or 0 with an error. */
int rectray_render(const RectrayScene *scene, const RectraySettings *settings, RectrayBand band, void *user,
                   RectrayError *error);

/* Where a ray meets its first face. */
typedef struct RectrayHit {
    int face; /* as messages and walkthroughs number them; -1: it meets none */
    double t; /* the point is origin + t direction */
} RectrayHit;

/* Casts `count` rays of six numbers each: origin and direction, which need not have length 1, in the coordinates of the
 * scene file. A component is 0 or at least 1e-60; an origin is within 1e12 of the scene's centre, a direction has
 * components of at most 1e60. Returns 1, or 0 with an error. */
int rectray_cast(const RectrayScene *scene, const RectraySettings *settings, const double *rays, long count,
                 RectrayHit *hits, RectrayError *error);

/* The walkthrough of a pixel, as JSON: docs/walkthrough.schema.json. rectray_free frees it. NULL with an error. */
char *rectray_trace(const RectrayScene *scene, int column, int row, RectrayError *error);
void rectray_free(char *text);

#ifdef __GNUC__
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif

#endif
