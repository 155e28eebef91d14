/* ffmpeg is started by posix_spawn, without a shell. It gets the film's file as an open descriptor, not by a name: it
 * writes to the temporary file or, once a signal has removed that, to a file without a name. */
#include "picture/film.h"

#include "base/output.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

struct Film {
    Output output;
    pid_t ffmpeg;
    int pipe;       /* the end that frames are written to */
    FILE *messages; /* what ffmpeg says */
    char path[32];  /* of the pipe */
};

enum { FILM_FILE = 3 }; /* the descriptor by which ffmpeg knows its file */

/* --- Formats --- */

enum { MOST_OPTIONS = 12 };

/* What ffmpeg is told of a format. Players want an even number of columns and rows, and colours as in television. */
#define VIDEO "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv,format=yuv420p"
#define COLOURS "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709"

typedef struct FilmFormat {
    const char *ending;
    const char *options[MOST_OPTIONS + 1]; /* end in a NULL */
} FilmFormat;

static const FilmFormat formats[] = {
    {"mp4", {"-vf", VIDEO, "-c:v", "libx264", "-crf", "18", COLOURS}},
    {"webm", {"-vf", VIDEO, "-c:v", "libvpx-vp9", "-crf", "24", COLOURS}},
    /* One palette for the whole film; ffmpeg holds its frames in memory until it has seen all of them. */
    {"gif", {"-filter_complex", "[0:v]split[a][b];[a]palettegen=stats_mode=diff[p];[b][p]paletteuse=dither=none"}},
    {NULL, {NULL}},
};

static const FilmFormat *format_of(const char *path)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path, *dot = strrchr(name, '.');
    const FilmFormat *format = formats;
    while (format->ending && !(dot && strcasecmp(dot + 1, format->ending) == 0))
        format++;
    return format->ending ? format : NULL;
}

bool film_is(const char *path)
{
    return format_of(path) != NULL;
}

/* --- ffmpeg --- */

static bool spawn(Film *film, const char *const *argv, int input, Error *error)
{
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, fileno(film->messages), STDERR_FILENO);
    posix_spawn_file_actions_adddup2(&actions, fileno(film->output.file), FILM_FILE);
    /* The cast is POSIX's: spawn does not write to the strings. */
    int status = posix_spawnp(&film->ffmpeg, argv[0], &actions, NULL, (char *const *)argv, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (status == 0)
        return true;
    film->ffmpeg = 0;
    return error_set(error, ERROR_SYSTEM,
                     status == ENOENT
                         ? "ffmpeg is not installed, which makes the film %s; install it, or render single "
                           "frames: -o 'frame-%%04d.png'"
                         : "cannot start ffmpeg for the film %s: %s",
                     film->output.path, strerror(status));
}

static bool start(Film *film, const FilmFormat *format, int columns, int rows, double fps, Error *error)
{
    enum { BEFORE = 16, MOST = BEFORE + MOST_OPTIONS + 8 };
    char size[32], rate[32];
    const char *argv[MOST] = {"ffmpeg", "-loglevel",   "error", "-y",         "-f", "rawvideo", "-pixel_format",
                              "rgb24",  "-video_size", size,    "-framerate", rate, "-i",       "pipe:0"};
    int count = 14, ends[2];
    snprintf(size, sizeof size, "%dx%d", columns, rows);
    snprintf(rate, sizeof rate, "%.10g", fps);
    for (int i = 0; format->options[i]; i++)
        argv[count++] = format->options[i];
    argv[count++] = "-f";
    argv[count++] = format->ending;
    argv[count++] = "file:/dev/fd/3";
    film->messages = tmpfile();
    if (!film->messages || pipe(ends) != 0)
        return error_set(error, ERROR_SYSTEM, "cannot make a pipe to ffmpeg: %s", strerror(errno));
    fcntl(fileno(film->messages), F_SETFD, FD_CLOEXEC);
    fcntl(ends[0], F_SETFD, FD_CLOEXEC);
    fcntl(ends[1], F_SETFD, FD_CLOEXEC);
    film->pipe = ends[1];
    snprintf(film->path, sizeof film->path, "/dev/fd/%d", film->pipe);
    bool started = spawn(film, argv, ends[0], error);
    close(ends[0]);
    return started;
}

/* Ends the pipe, waits, and tells whether ffmpeg has done its work; else the error has its last words. */
static bool end(Film *film, Error *error)
{
    int status = 0;
    char words[512];
    close(film->pipe);
    film->pipe = -1;
    while (waitpid(film->ffmpeg, &status, 0) < 0 && errno == EINTR)
        ;
    film->ffmpeg = 0;
    struct stat file;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0 &&
        (fstat(fileno(film->output.file), &file) != 0 || file.st_size > 0))
        return true;
    rewind(film->messages);
    words[fread(words, 1, sizeof words - 1, film->messages)] = '\0';
    words[strcspn(words, "\n")] = '\0'; /* the first line */
    return error_set(error, ERROR_SYSTEM, "ffmpeg could not make the film %s: %s", film->output.path,
                     words[0]              ? words
                     : WIFSIGNALED(status) ? "a signal ended it"
                                           : "it made no film, and does not say why");
}

/* --- Films --- */

static void film_free(Film *film)
{
    if (film->pipe >= 0)
        close(film->pipe);
    if (film->messages)
        fclose(film->messages);
    output_abort(&film->output);
    free(film);
}

Film *film_open(const char *path, int columns, int rows, double fps, Error *error)
{
    Film *film = calloc(1, sizeof *film);
    if (!film) {
        error_memory(error, "a film");
        return NULL;
    }
    film->pipe = -1;
    if (output_open(&film->output, path, "the film", error) && start(film, format_of(path), columns, rows, fps, error))
        return film;
    film_free(film);
    return NULL;
}

const char *film_pipe(const Film *film)
{
    return film->path;
}

bool film_commit(Film *film, Error *error)
{
    bool done = end(film, error) && output_commit(&film->output, error);
    film_free(film);
    return done;
}

void film_abort(Film *film, bool pipe_is_broken, Error *error)
{
    int status;
    if (!film)
        return;
    if (pipe_is_broken)
        end(film, error);
    else {
        kill(film->ffmpeg, SIGKILL);
        waitpid(film->ffmpeg, &status, 0);
    }
    film_free(film);
}
