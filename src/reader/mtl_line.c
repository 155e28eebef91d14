/* The keys of a material library, but for newmtl. To read a further one, add it to mtl_read_key. */
#include "reader/mtl_line.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Says that the material asks for something that it does not get. */
static bool remark(MtlReader *reader, NoteName note, long line, char *detail)
{
    return reader->now == &reader->dropped ||
           mtl_library_remark(reader->library, (MtlRemark){note, line, detail}, reader->scan.error);
}

/* One number is a grey. */
static bool read_colour(LineScan *scan, ScanWord key, Vec3 *colour)
{
    double c[4];
    int count;
    long line = scan->line;
    if (strncmp(scan->at, "spectral", 8) == 0 || strncmp(scan->at, "xyz", 3) == 0)
        return scan_fail(scan, line, "%.*s: spectral and xyz colours are not read; write red, green and blue",
                         key.length, key.text);
    if (!scan_numbers(scan, c, 4, &count))
        return false;
    if (count != 1 && count != 3)
        return scan_fail(scan, line, "%.*s needs three numbers, or one for a grey, not %d", key.length, key.text,
                         count);
    if (count == 1)
        c[1] = c[2] = c[0];
    for (int i = 0; i < 3; i++)
        if (!(c[i] >= 0 && c[i] <= SCENE_MAX_COLOUR))
            return scan_fail(scan, line, "%.*s: %g is not from 0 to %g", key.length, key.text, c[i], SCENE_MAX_COLOUR);
    *colour = vec3(c[0], c[1], c[2]);
    return scan_next_line(scan);
}

static bool read_shininess(LineScan *scan, double *shininess)
{
    int count;
    double number;
    long line = scan->line;
    if (!scan_numbers(scan, &number, 1, &count))
        return false;
    if (count != 1 || !(number >= 0 && number <= SCENE_MAX_SHININESS))
        return scan_fail(scan, line, "Ns needs a number from 0 to %g", SCENE_MAX_SHININESS);
    *shininess = number;
    return scan_next_line(scan);
}

/* The last number of a line that may begin with words, as in "d -halo 0.5"; -1 where there is none. */
static double last_number(LineScan *scan)
{
    double value = -1;
    while (!scan_line_ends(scan)) {
        ScanWord word = scan_word(scan);
        char *end;
        double x = strtod(word.text, &end);
        value = end == word.text + word.length ? x : value;
    }
    return value;
}

static bool is_one_of(ScanWord key, const char *const *words)
{
    while (*words && !scan_word_is(key, *words))
        words++;
    return *words != NULL;
}

/* "KEY REST", for a note. */
static void describe(MtlReader *reader, ScanWord key, char detail[MTL_DETAIL])
{
    char word[32];
    snprintf(word, sizeof word, "%.*s", key.length, key.text);
    Quoted quoted = text_quote(word); /* used without its quotation marks */
    int length = (int)strlen(quoted.text) - 2;
    snprintf(detail, MTL_DETAIL, "%.*s %s", length, quoted.text + 1, text_quote(scan_rest(&reader->scan)).text);
}

/* Keys that ask for what is not done. */
static bool read_unused(MtlReader *reader, ScanWord key)
{
    static const char *const pictures[] = {"bump", "disp", "decal", "refl", "norm", NULL};
    static const char *const physical[] = {"Pr", "Pm", "Ps", "Pc", "Pcr", "aniso", "anisor", NULL};
    static const char *const needless[] = {"Ni", "Tf", "sharpness", "Km", NULL}; /* say nothing of an opaque face */
    long line = reader->scan.line;
    char detail[MTL_DETAIL];
    if (is_one_of(key, needless))
        return scan_next_line(&reader->scan);
    bool diffuse = scan_word_is(key, "map_Kd");
    bool picture = strncasecmp(key.text, "map_", 4) == 0 || is_one_of(key, pictures);
    bool is_physical = is_one_of(key, physical);
    describe(reader, key, detail);
    if (diffuse) {
        memcpy(reader->draft.picture, detail, sizeof detail);
        reader->draft.picture_line = line;
        return true;
    }
    if (picture || is_physical)
        return remark(reader, picture ? NOTE_PICTURE : NOTE_PHYSICAL, line, detail);
    NotePlace place = {.line = line, .detail = detail};
    return notes_add(reader->notes, &note_kinds[NOTE_UNKNOWN], reader->scan.path, place, reader->scan.error);
}

static bool read_emission(MtlReader *reader, ScanWord key)
{
    Vec3 colour;
    char detail[MTL_DETAIL];
    long line = reader->scan.line;
    if (!read_colour(&reader->scan, key, &colour))
        return false;
    snprintf(detail, sizeof detail, "Ke %.6g %.6g %.6g", colour.x, colour.y, colour.z);
    return vec3_largest(colour) == 0 || remark(reader, NOTE_EMISSION, line, detail);
}

/* "illum", "d" and "Tr". A line without a number from 0 is left out. */
static bool read_request(MtlReader *reader, ScanWord key)
{
    MtlDraft *draft = &reader->draft;
    char detail[MTL_DETAIL];
    long line = reader->scan.line;
    double number = last_number(&reader->scan);
    snprintf(detail, sizeof detail, "%.*s, which needs a number from 0", key.length, key.text);
    if (!(number >= 0))
        return remark(reader, NOTE_UNKNOWN, line, detail) && scan_next_line(&reader->scan);
    if (scan_word_is(key, "illum")) {
        draft->illum = (int)fmin(number, 1000);
        draft->illum_line = line;
    } else {
        *(key.length == 1 ? &draft->opaque : &draft->transparent) = number;
        draft->opacity_line = line;
    }
    return scan_next_line(&reader->scan);
}

/* Of what is given twice, the last counts. */
static bool watch_repeats(MtlReader *reader, ScanWord key)
{
    static const char *const keys[] = {"Ka", "Kd", "Ks", "Ns", "Ke", "illum", "d", "Tr", "map_Kd"};
    for (unsigned i = 0; i < sizeof keys / sizeof *keys; i++) {
        if (!scan_word_is(key, keys[i]))
            continue;
        bool repeats = reader->draft.given >> i & 1;
        reader->draft.given |= 1u << i;
        return !repeats || remark(reader, NOTE_VALUE_TWICE, reader->scan.line, scan_quote(key).text);
    }
    return true;
}

bool mtl_read_key(MtlReader *reader, ScanWord key)
{
    LineScan *scan = &reader->scan;
    Material *material = &reader->now->material;
    if (!watch_repeats(reader, key))
        return false;
    if (scan_word_is(key, "Ka")) {
        reader->now->ambient_line = scan->line;
        return read_colour(scan, key, &material->ambient);
    }
    if (scan_word_is(key, "Kd")) {
        reader->draft.has_diffuse = true;
        return read_colour(scan, key, &material->diffuse);
    }
    if (scan_word_is(key, "Ks"))
        return read_colour(scan, key, &material->specular);
    if (scan_word_is(key, "Ns"))
        return read_shininess(scan, &material->shininess);
    if (scan_word_is(key, "Ke"))
        return read_emission(reader, key);
    if (scan_word_is(key, "illum") || scan_word_is(key, "d") || scan_word_is(key, "Tr"))
        return read_request(reader, key);
    return read_unused(reader, key);
}

/* illum 3, 5 and 8 are mirrors. */
static bool finish_illum(MtlReader *reader)
{
    const MtlDraft *draft = &reader->draft;
    Material *material = &reader->now->material;
    double mean = (material->specular.x + material->specular.y + material->specular.z) / 3;
    char detail[MTL_DETAIL];
    if (draft->illum == 3 || draft->illum == 5 || draft->illum == 8) {
        material->reflection = fmin(mean, 1);
        snprintf(detail, sizeof detail, "illum %d, reflection %.6g", draft->illum, material->reflection);
        return remark(reader, NOTE_MIRROR, draft->illum_line, detail);
    }
    static const char *const asks[] = {
        "its colour without light", "no highlight", "", "", "glass", "", "refraction", "refraction", "", "glass",
        "shadows on nothing"};
    bool is_known = draft->illum >= 0 && draft->illum < (int)(sizeof asks / sizeof *asks);
    snprintf(detail, sizeof detail, "illum %d asks for %s", draft->illum,
             is_known ? asks[draft->illum] : "what MTL does not define");
    bool done = draft->illum == -1 || draft->illum == 2 || (draft->illum == 1 && mean == 0);
    return done || remark(reader, NOTE_ILLUM, draft->illum_line, detail);
}

bool mtl_finish_material(MtlReader *reader)
{
    MtlDraft *draft = &reader->draft;
    NoteName picture = draft->has_diffuse ? NOTE_PICTURE : NOTE_PICTURE_ONLY;
    if (draft->picture[0] && !remark(reader, picture, draft->picture_line, draft->picture))
        return false;
    bool lets_through = draft->opaque >= 0 ? draft->opaque < 1 : draft->transparent > 0;
    char detail[MTL_DETAIL];
    snprintf(detail, sizeof detail, draft->opaque >= 0 ? "d %.6g" : "Tr %.6g",
             draft->opaque >= 0 ? draft->opaque : draft->transparent);
    if (lets_through && !remark(reader, NOTE_OPACITY, draft->opacity_line, detail))
        return false;
    return finish_illum(reader);
}
