/* The page with a scene in it: the template, and at its mark the wishes and the files, as src/page/build.sh writes
 * them. */
#include "page/explore.h"

#include "base/text.h"
#include "page/explore_files.h"
#include "json/json_node.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

bool explore_check(Error *error)
{
    return page_template ||
           error_set(error, ERROR_SYSTEM,
                     "this program was built without the page; `make page`, then `make`, builds it in");
}

/* --- The files --- */

/* Any bytes, as text that may stand in HTML: RFC 4648, section 4. */
static void write_base64(FILE *out, const char *text, long length)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const unsigned char *bytes = (const unsigned char *)text;
    for (long i = 0; i < length; i += 3) {
        long left = length - i;
        unsigned bits =
            (unsigned)bytes[i] << 16 | (left > 1 ? (unsigned)bytes[i + 1] << 8 : 0) | (left > 2 ? bytes[i + 2] : 0);
        fputc(digits[bits >> 18], out);
        fputc(digits[bits >> 12 & 63], out);
        fputc(left > 1 ? digits[bits >> 6 & 63] : '=', out);
        fputc(left > 2 ? digits[bits & 63] : '=', out);
    }
}

/* Text in an attribute, or in a script's JSON, where no tag may begin. */
static void write_escaped(FILE *out, const char *text, bool in_json)
{
    for (; *text; text++)
        if (*text == '<')
            fputs(in_json ? "\\u003c" : "&lt;", out);
        else if (!in_json && (*text == '&' || *text == '"'))
            fputs(*text == '&' ? "&amp;" : "&quot;", out);
        else
            fputc(*text, out);
}

static bool check_size(const ExploreFiles *files, Error *error)
{
    long long bytes = 0;
    for (int i = 0; i < files->count; i++) {
        struct stat status;
        if (stat(files->items[i].path, &status) != 0)
            return text_fail_errno(files->items[i].path, "cannot be read", error);
        bytes += status.st_size;
    }
    return bytes <= EXPLORE_MAX_BYTES ||
           error_set(error, ERROR_INPUT,
                     "%s: with its models it holds %.1f MB; explore puts scenes of up to %d MB into a page",
                     files->items[0].path, (double)bytes / 1048576, EXPLORE_MAX_BYTES / 1048576);
}

static bool write_file(FILE *out, const ExploreFile *file, Error *error)
{
    long length;
    char *bytes = text_read(file->path, EXPLORE_MAX_BYTES, &length, error);
    if (!bytes)
        return false;
    fputs("<script type=\"application/octet-stream\" data-file=\"", out);
    write_escaped(out, file->name, false);
    fputs("\">", out);
    write_base64(out, bytes, length);
    fputs("</script>\n", out);
    free(bytes);
    return true;
}

/* --- The wishes --- */

static bool write_wishes(FILE *out, const char *scene_path, const ExploreWishes *wishes, Error *error)
{
    bool failed = false;
    JsonNode node = json_node_new(&failed);
    json_node_text(node, "scene", scene_path);
    if (wishes->columns > 0) {
        JsonNode size = json_node_array(node, "size");
        json_node_append_number(size, wishes->columns);
        json_node_append_number(size, wishes->rows);
    }
    if (wishes->grid > 0)
        json_node_number(node, "grid", wishes->grid);
    if (wishes->pixel_given) {
        JsonNode pixel = json_node_array(node, "pixel");
        json_node_append_number(pixel, wishes->column);
        json_node_append_number(pixel, wishes->row);
    }
    char *text = failed ? NULL : cJSON_PrintUnformatted(node.object);
    if (text) {
        fputs("<script type=\"application/json\" id=\"wishes\">", out);
        write_escaped(out, text, true);
        fputs("</script>\n", out);
    }
    cJSON_free(text);
    cJSON_Delete(node.object);
    return text || error_memory(error, "the page");
}

static bool write_scene(FILE *out, const ExploreFiles *files, const ExploreWishes *wishes, Error *error)
{
    bool good = check_size(files, error) && write_wishes(out, files->items[0].path, wishes, error);
    for (int i = 0; good && i < files->count; i++)
        good = write_file(out, &files->items[i], error);
    return good;
}

bool explore_write(FILE *out, const char *scene_path, const ExploreWishes *wishes, Error *error)
{
    static const char mark[] = "\n@FILES@\n";
    if (!explore_check(error))
        return false;
    const char *place = strstr(page_template, mark), *rest = place + sizeof mark - 1;
    ExploreFiles files;
    bool good = explore_find_files(&files, scene_path, error);
    if (good) {
        fwrite(page_template, 1, (size_t)(place + 1 - page_template), out);
        good = write_scene(out, &files, wishes, error);
        fwrite(rest, 1, (size_t)(page_template + page_template_length - rest), out);
    }
    explore_free_files(&files);
    return good;
}
