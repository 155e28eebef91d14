/* Devices, and what their check found, as text and as JSON. */
#ifndef RECTRAY_DEVICE_REPORT_H
#define RECTRAY_DEVICE_REPORT_H

#include "command/device_check.h"

/* Prints device `number` of the list, or all where it is -1. Fails only for want of memory. */
bool device_report_list(const DeviceInfo *devices, int count, int number, bool json, Error *error);

/* For a DeviceCheckListener: a row for each step, begun before it runs. */
void device_report_before(void *user, const DeviceCheckStep *step);
void device_report_after(void *user, const DeviceCheckStep *step);

/* Prints the device and what is to be said of all steps. */
void device_report_verdict(const DeviceCheck *check);

/* Prints one object with the device, the steps and the verdict. Fails only for want of memory. */
bool device_report_json(const DeviceCheck *check, Error *error);

#endif
