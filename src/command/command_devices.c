/* rectray devices: the OpenCL devices with the numbers that --device takes. With --check: whether one works. */
#include "command/command.h"
#include "command/device_check.h"
#include "command/device_report.h"

#include <stdlib.h>

/* --- The check --- */

static void say_nothing(void *user, const DeviceCheckStep *step)
{
    (void)user;
    (void)step;
}

static bool check_device(const Options *options, int number, Error *error)
{
    DeviceCheck *check = calloc(1, sizeof *check);
    if (!check)
        return error_memory(error, "the check of a device");
    DeviceCheckListener rows = {device_report_before, device_report_after, NULL},
                        silent = {say_nothing, say_nothing, NULL};
    bool ok = device_check(check, number, options->json ? silent : rows, error);
    if (ok && options->json)
        ok = device_report_json(check, error);
    else if (ok)
        device_report_verdict(check);
    if (ok && check->wrong > 0)
        ok = error_set(
            error, ERROR_SYSTEM,
            "device %d is wrong in %d of %d checks; docs/devices.md tells what to do, and --backend reference "
            "needs no device",
            check->device.number, check->wrong, check->count);
    free(check);
    return ok;
}

/* --- The list --- */

/* The operand; -1 where there is none. */
static bool read_number(const Options *options, int *number, Error *error)
{
    *number = -1;
    if (options->operand_count == 0 || option_read_int(options->operands[0], 0, 9999, '\0', number))
        return true;
    return error_set(error, ERROR_USAGE, "devices '%s': expected a number that `rectray devices` lists",
                     options->operands[0]);
}

bool command_devices(const Options *options, Error *error)
{
    int number;
    if (!read_number(options, &number, error))
        return false;
    if (options->check)
        return check_device(options, number, error);
    DeviceInfo *devices = NULL;
    int count = 0;
    if (!opencl_devices(&devices, &count, error))
        return false;
    bool ok =
        number < count || error_set(error, ERROR_USAGE, "devices %d: there is no such device; the devices are 0 to %d",
                                    number, count - 1);
    ok = ok && device_report_list(devices, count, number, options->json, error);
    free(devices);
    return ok;
}
