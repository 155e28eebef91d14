/* What grading has found, as text and as JSON: docs/grade.schema.json. */
#ifndef RECTRAY_GRADE_REPORT_H
#define RECTRAY_GRADE_REPORT_H

#include "grade/grade.h"
#include "grade/grade_picture.h"

#include <stdio.h>

/* What was graded, as the user named it. */
typedef struct GradeReport {
    FILE *out;
    const char *scene, *given; /* the names of the files */
    Tolerance tolerance;       /* of a picture: absolute is a number of bytes */
} GradeReport;

void grade_report_text(const GradeReport *report, const Grade *grade);
void grade_report_picture_text(const GradeReport *report, const GradePicture *grade);

/* False without memory. */
bool grade_report_json(const GradeReport *report, const Grade *grade, Error *error);
bool grade_report_picture_json(const GradeReport *report, const GradePicture *grade, Error *error);

#endif
