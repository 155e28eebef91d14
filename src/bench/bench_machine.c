/* The machine, as Linux tells of it. */
#include "bench/bench_machine.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *bench_processor(char *name, size_t size)
{
    char line[256];
    snprintf(name, size, "unknown processor");
    FILE *file = fopen("/proc/cpuinfo", "r");
    while (file && fgets(line, sizeof line, file)) {
        const char *colon = strchr(line, ':');
        if (colon && strncmp(line, "model name", 10) == 0) {
            snprintf(name, size, "%.*s", (int)strcspn(colon + 2, "\n"), colon + 2);
            break;
        }
    }
    if (file)
        fclose(file);
    return name;
}

double bench_load(void)
{
    char line[64] = "";
    FILE *file = fopen("/proc/loadavg", "r");
    if (file) {
        line[fread(line, 1, sizeof line - 1, file)] = '\0';
        fclose(file);
    }
    return strtod(line, NULL);
}
