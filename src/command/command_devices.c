/* rectray devices: the OpenCL devices with the numbers that --device takes. */
#include "command/command.h"
#include "opencl/opencl_device.h"

#include <stdlib.h>

static void print_device(const DeviceInfo *device)
{
    printf("%d: %s (%s)\n", device->number, device->name, device->type);
    printf("   platform       %s\n", device->platform);
    printf("   version        %s, driver %s\n", device->version, device->driver);
    printf("   compute units  %d\n", device->compute_units);
    printf("   memory         %.1f GiB\n", (double)device->memory_bytes / 1073741824);
    if (device->has_double)
        printf("   rays at once   %d in float, %d in double\n", device->lanes_float, device->lanes_double);
    else
        printf("   rays at once   %d in float; no double\n", device->lanes_float);
}

bool command_devices(const Options *options, Error *error)
{
    (void)options;
    DeviceInfo *devices = NULL;
    int count = 0;
    if (!opencl_devices(&devices, &count, error))
        return false;
    for (int i = 0; i < count; i++)
        print_device(&devices[i]);
    free(devices);
    return true;
}
