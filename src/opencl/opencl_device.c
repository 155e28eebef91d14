/* Finding a device: platforms and devices in the loader's order, and what suits each. */
#include "opencl/opencl_device.h"

#include "base/parallel.h"
#include "opencl/opencl_status.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A string property cut to the size of `text`; "unknown" when the device does not tell. */
static void device_text(cl_device_id device, cl_device_info key, char *text, size_t size)
{
    char value[1024] = "";
    if (clGetDeviceInfo(device, key, sizeof value - 1, value, NULL) != CL_SUCCESS || !value[0])
        strcpy(value, "unknown");
    snprintf(text, size, "%.*s", (int)size - 1, value);
}

static cl_ulong device_number(cl_device_id device, cl_device_info key, size_t size)
{
    union {
        cl_uint narrow;
        cl_ulong wide;
    } value = {.wide = 0};
    if (clGetDeviceInfo(device, key, size, &value, NULL) != CL_SUCCESS)
        return 0;
    return size == sizeof value.narrow ? value.narrow : value.wide;
}

/* As many rays as a register holds on a processor, which runs a work-item as one thread; one elsewhere. */
static int lanes_for(bool is_cpu, cl_ulong native_width)
{
    if (!is_cpu)
        return 1;
    return native_width >= 16 ? 16 : native_width >= 8 ? 8 : 4;
}

static DeviceInfo describe(cl_device_id device, const char *platform, int number)
{
    DeviceInfo info = {.number = number};
    snprintf(info.platform, sizeof info.platform, "%s", platform);
    device_text(device, CL_DEVICE_NAME, info.name, sizeof info.name);
    device_text(device, CL_DEVICE_VERSION, info.version, sizeof info.version);
    device_text(device, CL_DRIVER_VERSION, info.driver, sizeof info.driver);
    device_text(device, CL_DEVICE_OPENCL_C_VERSION, info.c_version, sizeof info.c_version);
    cl_ulong type = device_number(device, CL_DEVICE_TYPE, sizeof(cl_device_type));
    bool is_cpu = (type & CL_DEVICE_TYPE_CPU) != 0;
    strcpy(info.type, is_cpu ? "CPU" : type & CL_DEVICE_TYPE_GPU ? "GPU" : "accelerator");
    info.compute_units = (int)device_number(device, CL_DEVICE_MAX_COMPUTE_UNITS, sizeof(cl_uint));
    info.has_double = device_number(device, CL_DEVICE_DOUBLE_FP_CONFIG, sizeof(cl_device_fp_config)) != 0;
    info.memory_bytes = (long long)device_number(device, CL_DEVICE_GLOBAL_MEM_SIZE, sizeof(cl_ulong));
    info.lanes_float = lanes_for(is_cpu, device_number(device, CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT, sizeof(cl_uint)));
    info.lanes_double = lanes_for(is_cpu, device_number(device, CL_DEVICE_NATIVE_VECTOR_WIDTH_DOUBLE, sizeof(cl_uint)));
    return info;
}

typedef struct DeviceList {
    DeviceInfo *infos;
    cl_device_id *ids;
    int count;
    cl_int failed; /* the status of a platform that could not tell its devices; the others serve all the same */
} DeviceList;

static void list_free(DeviceList *list)
{
    free(list->infos);
    free(list->ids);
    *list = (DeviceList){0};
}

static bool list_add_platform(DeviceList *list, cl_platform_id platform, Error *error)
{
    enum { MAX_DEVICES = 64 };
    cl_device_id found[MAX_DEVICES];
    cl_uint count = 0;
    cl_int status = clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, MAX_DEVICES, found, &count);
    if (status != CL_SUCCESS && status != CL_DEVICE_NOT_FOUND)
        list->failed = status;
    if (status != CL_SUCCESS || count == 0)
        return true;
    if (count > MAX_DEVICES)
        count = MAX_DEVICES;
    size_t total = (size_t)list->count + count;
    DeviceInfo *infos = realloc(list->infos, total * sizeof *infos);
    if (infos)
        list->infos = infos;
    cl_device_id *ids = realloc(list->ids, total * sizeof *ids);
    if (ids)
        list->ids = ids;
    if (!infos || !ids)
        return error_memory(error, "the list of devices");
    char name[128] = "unknown";
    clGetPlatformInfo(platform, CL_PLATFORM_NAME, sizeof name - 1, name, NULL);
    for (cl_uint i = 0; i < count; i++, list->count++) {
        ids[list->count] = found[i];
        infos[list->count] = describe(found[i], name, list->count);
    }
    return true;
}

static bool list_devices(DeviceList *list, Error *error)
{
    enum { MAX_PLATFORMS = 64 };
    cl_platform_id platforms[MAX_PLATFORMS];
    cl_uint count = 0;
    cl_int status = clGetPlatformIDs(MAX_PLATFORMS, platforms, &count);
    if (status != CL_SUCCESS || count == 0)
        return error_set(error, ERROR_SYSTEM,
                         "no OpenCL platform was found; install one (Debian: pocl-opencl-icd, or run `make setup`), "
                         "or use --backend reference");
    if (count > MAX_PLATFORMS)
        count = MAX_PLATFORMS;
    for (cl_uint i = 0; i < count; i++)
        if (!list_add_platform(list, platforms[i], error))
            return false;
    if (list->count > 0)
        return true;
    return opencl_ok(error, list->failed, "clGetDeviceIDs") &&
           error_set(error, ERROR_SYSTEM,
                     "OpenCL is installed but offers no device; install one (Debian: pocl-opencl-icd), "
                     "or use --backend reference");
}

bool opencl_devices(DeviceInfo **devices, int *count, Error *error)
{
    DeviceList list = {0};
    *devices = NULL;
    *count = 0;
    if (!list_devices(&list, error)) {
        list_free(&list);
        return false;
    }
    *devices = list.infos;
    *count = list.count;
    free(list.ids);
    return true;
}

static int default_device(const DeviceList *list)
{
    for (int i = 0; i < list->count; i++)
        if (strcmp(list->infos[i].platform, "Portable Computing Language") == 0)
            return i;
    return 0;
}

/* PoCL's threads, one for each processor, are to stay on theirs: left alone, two of them share one for milliseconds,
 * which is as long as a picture takes. Not where the process may not have all processors, or is to use some only: PoCL
 * would take the first ones. */
static void keep_threads_in_place(int threads)
{
    if (parallel_may_use_all() && (threads == 0 || threads == parallel_threads(0)))
        setenv("POCL_AFFINITY", "1", 0);
}

/* PoCL compiles a kernel for launches of any size when it is to be kept, and before that for the size of the first
 * launch. Here groups are single work-items, for which the two are as fast. */
static void compile_once(void)
{
    setenv("POCL_WORK_GROUP_SPECIALIZATION", "0", 0);
}

bool opencl_find_device(int number, int threads, cl_device_id *device, DeviceInfo *info, Error *error)
{
    keep_threads_in_place(threads);
    compile_once();
    if (threads > 0) {
        char text[16];
        snprintf(text, sizeof text, "%d", threads);
        setenv("POCL_MAX_PTHREAD_COUNT", text, 1);
        setenv("POCL_CPU_MAX_CU_COUNT", text, 1); /* its name from PoCL 4.0 on */
    }
    DeviceList list = {0};
    bool ok = list_devices(&list, error);
    if (ok && number >= list.count)
        ok = error_set(error, ERROR_USAGE,
                       "--device %d: there is no such device; the devices are 0 to %d (see `rectray devices`)", number,
                       list.count - 1);
    if (ok) {
        int index = number < 0 ? default_device(&list) : number;
        *device = list.ids[index];
        *info = list.infos[index];
    }
    list_free(&list);
    return ok;
}
