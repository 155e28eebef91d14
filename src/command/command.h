/* The program's commands, one file each. They take what the user asked for, write data to stdout and messages
 * to stderr, and return false with an Error; only main makes an exit status of it. To add one: its file, its line here,
 * its entry in command_table.c, and its name in the options (option_table.c) that it takes. */
#ifndef RECTRAY_COMMAND_H
#define RECTRAY_COMMAND_H

#include "base/error.h"
#include "command/options.h"

bool command_render(const Options *options, Error *error);
bool command_trace(const Options *options, Error *error);
bool command_explore(const Options *options, Error *error);
bool command_cast(const Options *options, Error *error);
bool command_check(const Options *options, Error *error);
bool command_compare(const Options *options, Error *error);
bool command_grade(const Options *options, Error *error);
bool command_devices(const Options *options, Error *error);
bool command_bench(const Options *options, Error *error);
bool command_bench_error(const Options *options, Error *error); /* `bench error`: called by command_bench */
bool command_bench_kernels(const Options *options, Error *error);
bool command_tree(const Options *options, Error *error);
bool command_frame(const Options *options, Error *error);
bool command_join(const Options *options, Error *error);
bool command_generate(const Options *options, Error *error);
bool command_kernels(const Options *options, Error *error);
bool command_help(const Options *options, Error *error);

#endif
