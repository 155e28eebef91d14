/* The programs of a session: which kernel files they are made of, with which options, and where they come from. */
#include "opencl/opencl_program.h"

#include "base/clock.h"
#include "opencl/opencl_kept.h"
#include "opencl/opencl_sources.h"
#include "opencl/opencl_status.h"

#include "kernels/shared/layout.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The end of the compiler's log is cut where the message is full; its first errors matter most. */
static bool report_build_failure(const OpenclSession *session, cl_program program, cl_int status, Error *error)
{
    size_t size = 0;
    clGetProgramBuildInfo(program, session->device, CL_PROGRAM_BUILD_LOG, 0, NULL, &size);
    char *log = calloc(size + 1, 1);
    if (!log)
        return error_memory(error, "the compiler's log");
    clGetProgramBuildInfo(program, session->device, CL_PROGRAM_BUILD_LOG, size, log, NULL);
    error_set(error, ERROR_SYSTEM, "the kernels do not compile for %s (%s); the compiler says:\n%s", session->info.name,
              opencl_status_name(status), log);
    free(log);
    return false;
}

/* wide_is_double: as the program has it. */
static void write_options(const OpenclSession *session, Variant variant, bool wide_is_double, char *options,
                          size_t room)
{
    int accel = variant.accel == ACCEL_BVH ? 1 : variant.accel == ACCEL_KDTREE ? 2 : 0;
    snprintf(options, room,
             "-DLANES=%d -DREAL_DOUBLE=%d -DHAS_DOUBLE=%d -DPACKETS=%d -DPACKETS_ACROSS=%d "
             "-DPACKET_COLUMNS=%d -DPACKET_ROWS=%d -DACCEL=%d -DNODE_WIDTH=%d "
             "-DBLOCK_ACROSS=%d -DSTACK_SIZE=%d -DFACE_RECORD_BYTES=%d -DPARAMETERS_BYTES=%d",
             session->lanes, session->precision == PRECISION_DOUBLE, wide_is_double,
             session->packets_across * session->packets_across, session->packets_across, session->packet_columns,
             session->lanes / session->packet_columns, accel, variant.node_width, session->block_across,
             variant.stack_size, (int)sizeof(FaceRecord), (int)sizeof(Parameters));
    size_t used = strlen(options);
    /* NVIDIA's compiler would take more of the 65 536 registers that all work-items share: docs/gpu.md, section 6. */
    bool few_registers = session->kernel == KERNEL_GPU && strstr(session->info.platform, "NVIDIA");
    snprintf(options + used, room - used, "%s%s", session->linear ? " -DLINEAR=1" : "",
             few_registers ? " -cl-nv-maxrregcount=128" : "");
}

/* How many programs a session has. */
static int program_count(const OpenclSession *session)
{
    return session->kernel != KERNEL_GPU ? 1 : session->adaptive ? OPENCL_PROGRAMS : PROGRAM_EXACT + 1;
}

/* The kernel file that includes all that the session needs. Tiles of several packets are classified where float has
 * double for its exact rays. */
static const char *root_of(const OpenclSession *session, int program)
{
    static const char *const uniform[] = {[PROGRAM_MAIN] = "gpu.cl", [PROGRAM_EXACT] = "gpu_exact.cl"};
    static const char *const adaptive[] = {[PROGRAM_MAIN] = "gpu_adaptive.cl",
                                           [PROGRAM_EXACT] = "gpu_adaptive_exact.cl",
                                           [PROGRAM_JUDGE] = "gpu_judge.cl"};
    if (session->casts)
        return session->casts_pairs ? "pairs/cast.cl" : "packet/cast.cl";
    if (session->kernel == KERNEL_PLAIN)
        return opencl_has_pairs(session) ? "pairs.cl" : "plain.cl";
    if (session->kernel == KERNEL_GPU)
        return session->adaptive ? adaptive[program] : uniform[program];
    if (session->adaptive)
        return "adaptive/refine.cl";
    bool classifies = session->precision == PRECISION_FLOAT && session->wide_is_double && session->packets_across > 1;
    return classifies ? "tile/render.cl" : "packet/render.cl";
}

static void notify_compiling(const OpenclSession *session)
{
    char text[256];
    snprintf(text, sizeof text, "compiling the kernels for %s, once", session->info.name);
    if (session->notice.show)
        session->notice.show(session->notice.user, text);
}

static bool build_program(OpenclSession *session, OpenclProgram *made, const char *sources, const char *options,
                          Error *error)
{
    made->program = opencl_kept_program(&session->info, session->context, session->device, made->key, options);
    if (made->program)
        return true;
    made->from_source = true;
    notify_compiling(session);
    cl_int status;
    made->program = clCreateProgramWithSource(session->context, 1, &sources, NULL, &status);
    if (!opencl_ok(error, status, "clCreateProgramWithSource"))
        return false;
    status = clBuildProgram(made->program, 1, &session->device, options, NULL, NULL);
    return status == CL_SUCCESS || report_build_failure(session, made->program, status, error);
}

void opencl_keep(OpenclSession *session)
{
    for (int i = 0; i < OPENCL_PROGRAMS; i++) {
        if (session->programs[i].from_source)
            opencl_keep_program(session->programs[i].program, session->programs[i].key);
        session->programs[i].from_source = false;
    }
}

static const char *tree_of(AccelKind accel)
{
    return accel == ACCEL_BVH ? "bvh" : accel == ACCEL_KDTREE ? "kdtree" : "all_faces";
}

/* A program that was built with the same options stays. */
static bool make_program(OpenclSession *session, int which, Variant variant, RenderReport *report, Error *error)
{
    OpenclProgram *made = &session->programs[which];
    const char *root = root_of(session, which);
    char options[sizeof made->built];
    /* The kernels for GPUs know no double; their exact passes and what judges pixels do. */
    bool wide_is_double = session->wide_is_double && (session->kernel != KERNEL_GPU || which != PROGRAM_MAIN);
    write_options(session, variant, wide_is_double, options, sizeof options);
    if (which == PROGRAM_MAIN)
        memcpy(report->build_options, options, sizeof options);
    if (made->program && strcmp(made->built, options) == 0)
        return true;
    if (made->program)
        clReleaseProgram(made->program);
    *made = (OpenclProgram){0};
    const char *arithmetic = opencl_has_pairs(session) ? OPENCL_PAIRS : render_arithmetics[session->arithmetic];
    char *sources = opencl_sources(root, tree_of(variant.accel), arithmetic, error);
    if (!sources)
        return false;
    made->key = opencl_kept_key(&session->info, root, sources, options);
    bool ok = build_program(session, made, sources, options, error);
    if (ok)
        memcpy(made->built, options, sizeof options);
    free(sources);
    return ok;
}

bool opencl_build(OpenclSession *session, Variant variant, RenderReport *report, Error *error)
{
    double start = clock_ms();
    bool ok = true;
    for (int i = 0; i < program_count(session) && ok; i++)
        ok = make_program(session, i, variant, report, error);
    report->compile_ms = clock_ms() - start;
    return ok;
}
