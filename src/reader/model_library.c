/* Which files an mtllib line of a model means. */
#include "reader/model_library.h"

#include "base/text.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum { WORDS_MOST = 16 };

static const char BLANKS[] = " \t\v\f";

/* The one entry of a folder ("" is the working directory) that is `name` but for its case; NULL where there is none, or
 * more than one. */
static char *entry_of_any_case(const char *folder, const char *name, Error *error)
{
    DIR *entries = opendir(*folder ? folder : ".");
    if (!entries && errno == ENOMEM)
        error_memory(error, "a folder");
    char *found = NULL;
    int count = 0;
    for (struct dirent *entry; entries && (entry = readdir(entries));)
        if (strcasecmp(entry->d_name, name) == 0 && count++ == 0)
            found = text_copy(entry->d_name, error);
    if (entries)
        closedir(entries);
    if (count > 1) {
        free(found);
        found = NULL;
    }
    return found;
}

/* Replaces each part of a path, from `at` on, by the entry that there is; NULL where there is none. Takes the path. */
static char *path_of_any_case(char *path, size_t at, Error *error)
{
    while (path[at]) {
        size_t end = at + strcspn(path + at, "/");
        char after = path[end], kept = path[at];
        path[end] = '\0';
        if (end > at && !text_exists(path)) {
            path[at] = '\0';
            char *folder = text_copy(path, error);
            path[at] = kept;
            char *entry = folder ? entry_of_any_case(folder, path + at, error) : NULL;
            free(folder);
            if (!entry) {
                free(path);
                return NULL;
            }
            memcpy(path + at, entry, end - at); /* a name of another case is as long */
            free(entry);
        }
        path[end] = after;
        at = end + (after == '/');
    }
    return path;
}

/* A folder or a pipe is no library. */
static bool is_file(const char *path)
{
    struct stat status;
    return text_exists(path) && (stat(path, &status) != 0 || S_ISREG(status.st_mode));
}

char *library_path(const char *beside, const char *name, bool *as_written, Error *error)
{
    char *path = text_beside(beside, name, error);
    *as_written = path && is_file(path);
    if (!path || *as_written)
        return path;
    size_t begin = strlen(path) - strlen(name);
    for (char *c = path + begin; *c; c++)
        if (*c == '\\')
            *c = '/';
    if (!text_exists(path))
        path = path_of_any_case(path, begin, error);
    if (path && !is_file(path)) {
        free(path);
        path = NULL;
    }
    return path;
}

static bool ends_in_mtl(const char *word, const char *end)
{
    return end - word >= 4 && strncasecmp(end - 4, ".mtl", 4) == 0;
}

void library_name_free(LibraryName *library)
{
    free(library->name);
    free(library->path);
    *library = (LibraryName){0};
}

/* The text between two places as a name, with the file that it means. False without memory. */
static bool take(LibraryName *library, const char *model, const char *begin, const char *end, Error *error)
{
    size_t length = (size_t)(end - begin);
    library->name = malloc(length + 1);
    if (!library->name)
        return error_memory(error, "a path");
    memcpy(library->name, begin, length);
    library->name[length] = '\0';
    library->path = library_path(model, library->name, &library->as_written, error);
    if (error->kind == ERROR_NONE)
        return true;
    library_name_free(library);
    return false;
}

bool library_name_next(LibraryName *library, const char *model, char **rest, Error *error)
{
    char *begin = *rest + strspn(*rest, BLANKS), *ends[WORDS_MOST], *missing = NULL;
    int count = 0;
    *library = (LibraryName){0};
    for (char *at = begin; *at && count < WORDS_MOST; at += strspn(at, BLANKS)) {
        char *word = at;
        at += strcspn(at, BLANKS);
        ends[count++] = at;
        if (!missing && (ends_in_mtl(word, at) || !at[strspn(at, BLANKS)]))
            missing = at;
    }
    for (int i = count - 1; i >= 0; i--) {
        *rest = ends[i];
        if (!take(library, model, begin, ends[i], error))
            return false;
        if (library->path)
            return true;
        library_name_free(library);
    }
    if (count == 0)
        return false;
    *rest = missing ? missing : ends[count - 1];
    return take(library, model, begin, *rest, error);
}
