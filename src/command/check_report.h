/* What `rectray check` tells of a valid scene, as text and as JSON. What it tells, it tells in both: to add a figure,
 * a line in check_text.c, a member in check_json.c and in docs/check.schema.json. */
#ifndef RECTRAY_CHECK_REPORT_H
#define RECTRAY_CHECK_REPORT_H

#include "base/error.h"
#include "command/hint_places.h"
#include "scene/hints.h"
#include "scene/scene.h"
#include "scene/survey.h"

typedef struct CheckReport {
    const char *path;
    const Scene *scene;
    Survey survey;
    Hints hints;
    HintPlaces places;
    int closed; /* faces of closed boxes, every other of which can be skipped */
    double primary_rays;
    int primary_tried; /* pixels from which their number is estimated; 0: it is exact */
} CheckReport;

/* Fails only for want of memory. The scene must outlive the report. check_report_free may be called in any case. */
bool check_report_make(CheckReport *report, const char *path, const Scene *scene, Error *error);
void check_report_free(CheckReport *report);

/* A light without colours adds nothing, but under the black rule it may keep a path going. */
bool check_black_lights_are_useless(const CheckReport *report);

/* Both print to standard output. */
void check_report_text(const CheckReport *report);

/* One document; with `every`, each note has all its places. */
bool check_report_json(const CheckReport *report, bool every, Error *error);

/* The document of a scene that is refused. Without memory there is none: the error's message is told anyway. */
void check_refusal_json(const char *path, const Error *refusal);

#endif
