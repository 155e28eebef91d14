/* Devices, and what their check found, as text and as JSON. */
#include "command/device_report.h"

#include "json/json_node.h"

#include <stdio.h>
#include <stdlib.h>

/* --- Text --- */

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

void device_report_before(void *user, const DeviceCheckStep *step)
{
    (void)user;
    printf("%-16s %-6s ", step->kernel, step->scene);
    fflush(stdout); /* a driver may end the program now; then this row tells which kernel it was */
}

void device_report_after(void *user, const DeviceCheckStep *step)
{
    (void)user;
    if (step->ran)
        printf("compiled in %6.0f ms, traced in %6.1f ms, %ld of %ld off%s\n", step->compile_ms, step->trace_ms,
               step->off, step->compared, step->right ? "" : ": WRONG");
    else
        printf("FAILED: %s\n", step->message);
}

static const char *verdict_of(const DeviceCheck *check)
{
    if (check->wrong > 0)
        return "wrong";
    return check->device.has_double ? "right" : "right without double";
}

void device_report_verdict(const DeviceCheck *check)
{
    printf("\n");
    print_device(&check->device);
    if (check->wrong > 0)
        printf("\nverdict: wrong in %d of %d checks\n", check->wrong, check->count);
    else
        printf("\nverdict: %s%s\n", verdict_of(check),
               check->device.has_double ? "" : "; docs/devices.md tells what is lost without double");
}

/* --- JSON --- */

static void add_device(JsonNode node, const DeviceInfo *device)
{
    json_node_number(node, "number", device->number);
    json_node_text(node, "name", device->name);
    json_node_text(node, "type", device->type);
    json_node_text(node, "platform", device->platform);
    json_node_text(node, "version", device->version);
    json_node_text(node, "driver", device->driver);
    json_node_text(node, "language", device->c_version);
    json_node_number(node, "compute_units", device->compute_units);
    json_node_number(node, "memory_bytes", (double)device->memory_bytes);
    json_node_bool(node, "double", device->has_double != 0);
    json_node_number(node, "lanes_float", device->lanes_float);
    json_node_number(node, "lanes_double", device->has_double ? device->lanes_double : 0);
}

static void add_step(JsonNode node, const DeviceCheckStep *step)
{
    json_node_text(node, "kernel", step->kernel);
    json_node_text(node, "scene", step->scene);
    json_node_bool(node, "right", step->right);
    json_node_bool(node, "ran", step->ran);
    json_node_number(node, "compile_ms", step->compile_ms);
    json_node_number(node, "trace_ms", step->trace_ms);
    json_node_number(node, "compared", (double)step->compared);
    json_node_number(node, "off", (double)step->off);
    json_node_number(node, "most_off", step->most_off);
    json_node_text(node, "message", step->message);
}

static bool print_node(JsonNode node, bool failed, Error *error)
{
    char *text = failed ? NULL : cJSON_PrintUnformatted(node.object);
    cJSON_Delete(node.object);
    if (!text)
        return error_memory(error, "the devices as JSON");
    printf("%s\n", text);
    cJSON_free(text);
    return true;
}

bool device_report_json(const DeviceCheck *check, Error *error)
{
    bool failed = false;
    JsonNode node = json_node_new(&failed);
    add_device(json_node_object(node, "device"), &check->device);
    JsonNode steps = json_node_array(node, "steps");
    for (int i = 0; i < check->count; i++)
        add_step(json_node_append_object(steps), &check->steps[i]);
    json_node_number(node, "wrong", check->wrong);
    json_node_text(node, "verdict", verdict_of(check));
    return print_node(node, failed, error);
}

bool device_report_list(const DeviceInfo *devices, int count, int number, bool json, Error *error)
{
    bool failed = false;
    JsonNode node = {0}, list = {0};
    if (json) {
        node = json_node_new(&failed);
        list = json_node_array(node, "devices");
    }
    for (int i = 0; i < count; i++) {
        if (number >= 0 && i != number)
            continue;
        if (json)
            add_device(json_node_append_object(list), &devices[i]);
        else
            print_device(&devices[i]);
    }
    return !json || print_node(node, failed, error);
}
