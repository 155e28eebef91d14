/* rectray grade: compares a walkthrough, or a picture, that another program made with ours, and names the slip. */
#include "base/text.h"
#include "command/command.h"
#include "command/scene_open.h"
#include "command/scene_override.h"
#include "grade/grade_report.h"

#include <math.h>
#include <stdio.h>

/* --- A walkthrough --- */

/* The pixel and the sample that are meant: those of the walkthrough, or of the options. */
static bool choose_pixel(const Options *options, const Scene *scene, const Given *given, WalkthroughRequest *request,
                         Error *error)
{
    const char *name = given->json.name;
    bool other = options->pixel_given && given->has_pixel &&
                 (options->pixel_column != given->column || options->pixel_row != given->row);
    if (!options->pixel_given && !given->has_pixel)
        return error_set(error, ERROR_USAGE,
                         "%s does not say of which pixel it tells; give it a \"pixel\", or say --pixel COLUMN,ROW",
                         name);
    if (other)
        return error_set(error, ERROR_USAGE, "--pixel %d,%d: %s tells of pixel %d,%d", options->pixel_column,
                         options->pixel_row, name, given->column, given->row);
    *request = (WalkthroughRequest){
        .column = given->has_pixel ? given->column : options->pixel_column,
        .row = given->has_pixel ? given->row : options->pixel_row,
        .i = given->i > 0 ? given->i : options->sample_i,
        .j = given->j > 0 ? given->j : options->sample_j,
    };
    if (request->column >= scene->screen.columns || request->row >= scene->screen.rows)
        return error_set(error, ERROR_USAGE, "pixel %d,%d is outside the picture, whose pixels are 0,0 to %d,%d",
                         request->column, request->row, scene->screen.columns - 1, scene->screen.rows - 1);
    return true;
}

static Tolerance tolerance_of(const Options *options)
{
    return options->tolerance_given ? (Tolerance){options->tolerance_absolute, options->tolerance_relative}
                                    : (Tolerance){GRADE_ABSOLUTE, GRADE_RELATIVE};
}

static bool tell(const Options *options, const Grade *grade, Error *error)
{
    GradeReport report = {stdout, text_input_name(options->operands[0]), grade->given->json.name,
                          tolerance_of(options)};
    if (options->json && !grade_report_json(&report, grade, error))
        return false;
    if (!options->json && !options->quiet)
        grade_report_text(&report, grade);
    return grade->same || error_set(error, ERROR_INPUT, "%s is not what %s gives", report.given, report.scene);
}

static bool grade_walkthrough(const Options *options, const Scene *scene, Error *error)
{
    Given given;
    Grade grade = {.given = NULL};
    WalkthroughRequest request;
    if (!given_load(&given, options->operands[1], error))
        return false;
    bool done = choose_pixel(options, scene, &given, &request, error) &&
                grade_make(&grade, scene, text_input_name(options->operands[0]), &given, request, tolerance_of(options),
                           error) &&
                tell(options, &grade, error);
    grade_free(&grade);
    given_free(&given);
    return done;
}

/* --- A picture --- */

static bool tell_picture(const Options *options, const GradePicture *grade, int tolerance, Error *error)
{
    GradeReport report = {stdout, text_input_name(options->operands[0]), options->picture, {tolerance, 0}};
    if (options->json && !grade_report_picture_json(&report, grade, error))
        return false;
    if (!options->json && !options->quiet)
        grade_report_picture_text(&report, grade);
    return grade->differing == 0 ||
           error_set(error, ERROR_INPUT, "%s is not the picture of %s", report.given, report.scene);
}

static bool grade_picture(const Options *options, const Scene *scene, Error *error)
{
    Image image = {0};
    GradePicture grade;
    int tolerance = options->tolerance_given ? (int)fmin(options->tolerance_absolute, 255) : 1;
    if (!image_read(&image, options->picture, error))
        return false;
    bool fits = image.columns == scene->screen.columns && image.rows == scene->screen.rows;
    if (!fits)
        error_set(error, ERROR_USAGE, "%s has %d x %d pixels, the scene %d x %d; say --size %dx%d if that is meant",
                  options->picture, image.columns, image.rows, scene->screen.columns, scene->screen.rows, image.columns,
                  image.rows);
    bool done = fits && grade_picture_make(&grade, scene, &image, tolerance, error) &&
                tell_picture(options, &grade, tolerance, error);
    image_free(&image);
    return done;
}

/* --- Both --- */

static bool check_operands(const Options *options, Error *error)
{
    if (options->picture && options->operand_count > 1)
        return error_set(error, ERROR_USAGE, "--picture grades a picture; leave out the walkthrough %s",
                         options->operands[1]);
    if (options->picture && options->pixel_given)
        return error_set(error, ERROR_USAGE, "--pixel is for a walkthrough; --picture grades every pixel");
    return options->picture || options->operand_count > 1 ||
           error_set(error, ERROR_USAGE, "grade needs a walkthrough, WALKTHROUGH.json, or --picture FILE");
}

bool command_grade(const Options *options, Error *error)
{
    Scene scene;
    if (!check_operands(options, error) || !scene_open(&scene, options, error))
        return false;
    scene_override(&scene, options);
    bool done = options->picture ? grade_picture(options, &scene, error) : grade_walkthrough(options, &scene, error);
    scene_free(&scene);
    return done;
}
