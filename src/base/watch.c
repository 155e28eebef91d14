/* inotify on the folders of the files, or, where there is none, the files' times and sizes. */
#define _XOPEN_SOURCE 700 /* nanosleep, st_mtim */
#include "base/watch.h"

#include "base/array.h"

#include <errno.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#ifdef __linux__
#include <poll.h>
#include <sys/inotify.h>
#endif

enum { QUIET_MS = 100 };

typedef struct Watched {
    char *path;
    const char *name; /* in its folder; "" for all of them */
    int folder;       /* inotify's number */
    struct timespec changed;
    long long size;
} Watched;

struct Watch {
    Watched *items;
    int count, capacity;
    int descriptor; /* of inotify; -1: none */
};

static bool failed(const char *what, const char *path, Error *error)
{
    return error_set(error, ERROR_SYSTEM, "cannot watch %s%s%s", what, path, strerror(errno));
}

/* --- Looking at the files --- */

/* Whether the file is not as it was; it is then as it is now. */
static bool has_changed(Watched *item)
{
    struct stat now = {0};
    if (stat(item->path, &now) != 0)
        now.st_size = -1;
    bool same = item->size == now.st_size && item->changed.tv_sec == now.st_mtim.tv_sec &&
                item->changed.tv_nsec == now.st_mtim.tv_nsec;
    item->size = now.st_size;
    item->changed = now.st_mtim;
    return !same;
}

static bool any_has_changed(Watch *watch)
{
    bool any = false;
    for (int i = 0; i < watch->count; i++)
        any = has_changed(&watch->items[i]) || any;
    return any;
}

static void sleep_quiet(void)
{
    nanosleep(&(struct timespec){0, QUIET_MS * 1000000L}, NULL);
}

static void look_until_quiet(Watch *watch)
{
    while (!any_has_changed(watch))
        sleep_quiet();
    do
        sleep_quiet();
    while (any_has_changed(watch));
}

/* --- inotify --- */

#ifdef __linux__
static int open_descriptor(void)
{
    return inotify_init1(IN_CLOEXEC);
}

/* The folder of a path, as inotify numbers it; -1 with errno. */
static int add_folder(int descriptor, const Watched *item)
{
    enum { CHANGES = IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_DELETE | IN_CREATE | IN_MODIFY };
    size_t length = (size_t)(item->name - item->path);
    char *folder = malloc(length + 3);
    if (!folder)
        return -1;
    memcpy(folder, item->path, length);
    memcpy(folder + length, length > 0 ? "" : "./", length > 0 ? 1 : 3);
    int number = inotify_add_watch(descriptor, folder, CHANGES);
    free(folder);
    return number;
}

static bool concerns(const Watch *watch, const struct inotify_event *event)
{
    for (int i = 0; i < watch->count; i++) {
        const Watched *item = &watch->items[i];
        if (item->folder == event->wd && (!item->name[0] || (event->len && strcmp(item->name, event->name) == 0)))
            return true;
    }
    return (event->mask & IN_Q_OVERFLOW) != 0;
}

/* Reads what has happened. *any: something happened to one of the files. */
static bool read_events(const Watch *watch, bool *any, Error *error)
{
    union {
        struct inotify_event event; /* for its alignment */
        char bytes[16384];
    } room;
    ssize_t length = read(watch->descriptor, room.bytes, sizeof room.bytes);
    *any = false;
    if (length < 0)
        return errno == EINTR || failed("the files: ", "", error);
    for (ssize_t at = 0; at < length;) {
        const struct inotify_event *event = (const struct inotify_event *)(const void *)(room.bytes + at);
        *any = *any || concerns(watch, event);
        at += (ssize_t)sizeof *event + (ssize_t)event->len;
    }
    return true;
}

static bool wait_for_events(const Watch *watch, Error *error)
{
    struct pollfd poll_descriptor = {.fd = watch->descriptor, .events = POLLIN};
    bool any = false, good = true;
    while (good && !any)
        good = read_events(watch, &any, error);
    while (good && poll(&poll_descriptor, 1, QUIET_MS) > 0)
        good = read_events(watch, &any, error);
    return good;
}
#else
static int open_descriptor(void)
{
    return -1;
}

static int add_folder(int descriptor, const Watched *item)
{
    (void)item;
    return descriptor;
}

static bool wait_for_events(const Watch *watch, Error *error)
{
    (void)watch;
    (void)error;
    return true;
}
#endif

/* --- The watch --- */

Watch *watch_open(Error *error)
{
    Watch *watch = calloc(1, sizeof *watch);
    if (watch)
        watch->descriptor = open_descriptor();
    else
        error_memory(error, "the watch");
    return watch;
}

bool watch_add(Watch *watch, const char *path, Error *error)
{
    for (int i = 0; i < watch->count; i++)
        if (strcmp(watch->items[i].path, path) == 0)
            return true;
    Watched *grown =
        array_grown(watch->items, watch->count, &watch->capacity, sizeof *grown, "the watched files", error);
    if (!grown)
        return false;
    watch->items = grown;
    Watched item = {.path = strdup(path)};
    if (!item.path)
        return error_memory(error, "the watched files");
    const char *slash = strrchr(item.path, '/');
    item.name = slash ? slash + 1 : item.path;
    has_changed(&item);
    if (watch->descriptor >= 0 && (item.folder = add_folder(watch->descriptor, &item)) < 0) {
        free(item.path);
        return failed(path, ": ", error);
    }
    watch->items[watch->count++] = item;
    return true;
}

bool watch_wait(Watch *watch, Error *error)
{
    if (watch->descriptor >= 0)
        return wait_for_events(watch, error);
    look_until_quiet(watch);
    return true;
}

void watch_close(Watch *watch)
{
    if (!watch)
        return;
    for (int i = 0; i < watch->count; i++)
        free(watch->items[i].path);
    free(watch->items);
    if (watch->descriptor >= 0)
        close(watch->descriptor);
    free(watch);
}
