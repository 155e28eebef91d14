/* The file of a model. */
#include "reader/scene_model.h"

#include "base/text.h"
#include "reader/scene_obj.h"
#include "reader/scene_ply.h"
#include "reader/scene_stl.h"

#include <string.h>
#include <strings.h>

/* --- Formats that are not read --- */

static const char EXPORT[] = "export the model as OBJ, PLY or STL, or convert it: assimp export MODEL model.obj";

/* How a file begins, what it is, and how to get a model of it. */
static const struct {
    const char *begin, *name, *cure;
} foreign[] = {
    {"<!doctype", "an HTML page", "download the model itself, not the page that shows it"},
    {"<html", "an HTML page", "download the model itself, not the page that shows it"},
    {"<?xml", "an XML file, such as Collada or X3D", EXPORT},
    {"<collada", "a Collada file", EXPORT},
    {"{", "a JSON file, such as glTF or CityJSON",
     "convert it: assimp export MODEL model.obj, or cjio MODEL export obj"},
    {"version https://git-lfs", "a pointer of Git LFS", "get the model itself: git lfs pull"},
    {"404: Not Found", "a server's answer that there is no such file", "download the model again"},
    {"\037\213", "a gzip archive", "unpack it: gunzip MODEL"},
    {"\211PNG", "a PNG picture", "name the model"},
    {"0\nSECTION", "a DXF file", EXPORT},
    {"0\r\nSECTION", "a DXF file", EXPORT},
    {"glTF", "a binary glTF file", EXPORT},
    {"PK\003\004", "a ZIP archive, such as 3MF or USDZ", "unpack it, or export the model as OBJ, PLY or STL"},
    {"Kaydara FBX", "an FBX file", EXPORT},
    {"; FBX", "an FBX file", EXPORT},
    {"BLENDER", "a Blender file", "open it in Blender and export the model as OBJ, PLY or STL"},
    {"VOX ", "a MagicaVoxel file", "open it in MagicaVoxel and export the model as OBJ"},
    {"#VRML", "a VRML file", EXPORT},
    {"#usda", "a USD file", EXPORT},
    {"PXR-USDC", "a USD file", EXPORT},
    {"OFF", "an OFF file", "convert it: meshlabserver -i MODEL -o model.ply"},
    {"ISO-10303-21", "a STEP or IFC file", "convert it with FreeCAD, or IfcConvert MODEL model.obj"},
    {"xof ", "a DirectX file", EXPORT},
    {"MM", "a 3ds file", EXPORT},
    {"newmtl ", "a material library", "name the model; its mtllib line names the library"},
    {"# Blender MTL", "a material library", "name the model; its mtllib line names the library"},
};

static bool begins(const char *text, const char *begin)
{
    return strncasecmp(text, begin, strlen(begin)) == 0;
}

/* --- Reading --- */

typedef struct Head {
    char bytes[1024];
    const char *text; /* of the bytes, ended by a NUL: after a byte order mark and blanks */
    long length;
    long size; /* of the file */
} Head;

static bool read_head(Head *head, const char *path, Error *error)
{
    FILE *file = text_open(path, error);
    if (!file)
        return false;
    head->length = (long)fread(head->bytes, 1, sizeof head->bytes - 1, file);
    bool good = !ferror(file) && fseek(file, 0, SEEK_END) == 0 && (head->size = ftell(file)) >= 0;
    if (!good)
        text_fail_errno(path, "cannot be read", error);
    fclose(file);
    head->bytes[head->length] = '\0';
    head->text = head->bytes + (begins(head->bytes, "\xEF\xBB\xBF") ? 3 : 0);
    head->text += strspn(head->text, " \t\r\n");
    return good;
}

static bool is_ply(const Head *head)
{
    return begins(head->text, "ply\n") || begins(head->text, "ply\r");
}

bool scene_model_read(SceneBuild *build, const char *path)
{
    Head head;
    if (!read_head(&head, path, build->error))
        return false;
    if (is_ply(&head))
        return scene_ply_read(build, path);
    if (scene_stl_is_binary(head.bytes, head.length, head.size))
        return scene_stl_read(build, path, true);
    for (size_t i = 0; i < sizeof foreign / sizeof *foreign; i++)
        if (begins(head.text, foreign[i].begin))
            return error_set(build->error, ERROR_INPUT, "%s: this is %s; %s", path, foreign[i].name, foreign[i].cure);
    if (head.length >= 84 && memchr(head.bytes, '\0', 84) && !text_is_utf16(head.bytes))
        return error_set(build->error, ERROR_INPUT,
                         "%s: is a binary file of no known format; if it is an STL, it is not whole", path);
    if (scene_stl_is_text(head.text))
        return scene_stl_read(build, path, false);
    return scene_obj_read(build, path);
}

bool scene_model_is_obj(const char *path, Error *error)
{
    Head head;
    return read_head(&head, path, error) && !is_ply(&head) && !scene_stl_is_text(head.text) &&
           !scene_stl_is_binary(head.bytes, head.length, head.size);
}
