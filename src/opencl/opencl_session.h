/* A device made ready: context, queue, programs and buffers. opencl_program.h builds the programs. */
#ifndef RECTRAY_OPENCL_SESSION_H
#define RECTRAY_OPENCL_SESSION_H

#include "opencl/kernel_cache.h"
#include "opencl/opencl_device.h"
#include "trace/render.h"

/* Where PoCL is told to specialise kernels, it compiles one once more for launches of more than 65535 work-groups. */
enum { OPENCL_MAX_BUFFERS = 24, OPENCL_MAX_ITEMS = 65535 };

/* A program, and what it is kept by for later runs. */
typedef struct OpenclProgram {
    cl_program program;
    KernelCacheKey key;
    char built[320];  /* its build options */
    bool from_source; /* it was compiled in this run, not kept from an earlier one */
} OpenclProgram;

/* The session's kernel; for a GPU the exact pass after it, and with adaptive sampling what judges the pixels. */
enum { PROGRAM_MAIN, PROGRAM_EXACT, PROGRAM_JUDGE, OPENCL_PROGRAMS };

/* Zero it, open it, build its kernels, close it; the buffers made with it are freed with it. */
typedef struct OpenclSession {
    DeviceInfo info;
    Precision precision;
    int lanes;
    int packet_columns, packets_across; /* a packet of lanes is so wide; a tile has so many packets across and down */
    int block_across;                   /* so many tiles side by side, and below one another, are a work-item's */
    int block_columns, block_rows;      /* their pixels */
    bool wide_is_double;                /* t comes back as double */
    bool casts_pairs;                   /* each number of a ray, and t, is two floats: the device has no double */
    KernelKind kernel;                  /* not KERNEL_AUTO */
    Arithmetic arithmetic;
    bool adaptive; /* the kernel is `render_adaptive`, or those of gpu_adaptive.cl */
    bool casts;    /* it is `cast`; else it is `render`. One is built: a compiler takes seconds for each */
    bool single;   /* it renders one picture only, so that its tree may be a cheap one */
    bool linear;   /* pixels come back as three reals, not clamped, instead of three bytes */
    cl_device_id device;
    cl_context context;
    cl_command_queue queue;
    OpenclProgram programs[OPENCL_PROGRAMS];
    unsigned no_skip; /* as in RenderSettings, like the shift */
    float shift;
    Notice notice;
    cl_mem buffers[OPENCL_MAX_BUFFERS];
    int buffer_count;
    void *taken[OPENCL_MAX_BUFFERS]; /* the memory of buffers that are no copies */
    int taken_count;
} OpenclSession;

/* Opens the device of the settings and chooses its number of lanes; time and device go to the report. */
bool opencl_open(OpenclSession *session, const RenderSettings *settings, RenderReport *report, Error *error);

/* Does exact arithmetic of one ray compute in pairs of floats? Textbook arithmetic knows one precision. */
bool opencl_has_pairs(const OpenclSession *session);

void opencl_close(OpenclSession *session);

/* Frees the buffers, so that others can be made; device and program stay. */
void opencl_drop(OpenclSession *session);

/* A buffer with a copy of `data`, or uninitialised where data is NULL; NULL with the error filled on failure. */
cl_mem opencl_buffer(OpenclSession *session, cl_mem_flags flags, size_t bytes, const void *data, Error *error);

/* A buffer for reading that takes over `data`, which array_aligned gave, also where it fails. On a CPU the buffer of a
 * large scene is that memory, so that the scene is not there twice; elsewhere it is a copy. */
cl_mem opencl_take(OpenclSession *session, void *data, size_t bytes, Error *error);

/* A kernel of the program, with its buffers as arguments, in order; the caller releases it. */
cl_kernel opencl_kernel(const OpenclProgram *program, const char *name, const cl_mem *arguments, int count,
                        Error *error);

/* Runs the kernel with at least `items` work-items and waits. */
bool opencl_run(OpenclSession *session, cl_kernel kernel, size_t items, Error *error);

#endif
