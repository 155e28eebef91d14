/* What a scene holds and what of it no ray can need: the figures of `rectray check`. Only what is certain is counted;
 * a face that merely happens to be hidden is not. */
#ifndef RECTRAY_SURVEY_H
#define RECTRAY_SURVEY_H

#include "scene/scene.h"

typedef struct Survey {
    int triangles, one_sided; /* of the faces as traced */
    int numbers;              /* faces of the file: a split face counts once */
    bool *material_used;      /* one per material */
    int mirrors, shiny;       /* faces whose material reflects; faces whose material has a specular colour */
    int lights_black;         /* lights whose three colours are black */
    int lights_ambient;       /* lights with an ambient colour only */
    bool shadow_rays;         /* whether any can be cast */
    bool reflections;         /* whether any path can go on */

    /* Faces that no primary ray can hit, by the first reason that holds. */
    int edge_on;        /* the camera is in the face's plane */
    int back_to_camera; /* one-sided, the camera behind it */
    int behind_camera;  /* no vertex before the camera */

    int unreachable; /* faces that no ray at all can hit: as above, and no light is blocked by them either */
} Survey;

/* Surveys a scene; false without memory. survey_free may be called in any case. */
bool survey_scene(Survey *survey, const Scene *scene, Error *error);

/* The same but for what takes a look at each face's place: the faces that no ray can hit are not counted. */
bool survey_materials(Survey *survey, const Scene *scene, Error *error);

/* In a scene without reflections: can no ray hit the face? */
bool survey_face_is_unreachable(const Scene *scene, int index);

void survey_free(Survey *survey);

#endif
