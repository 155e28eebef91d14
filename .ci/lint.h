/* Included before every source by `make lint` alone: clang-tidy looks at one source at a time and cannot know that
 * these always return false. */
#include "base/error.h"
#include "json/json.h"

#define error_set(...) (error_set(__VA_ARGS__), false)
#define error_memory(...) (error_memory(__VA_ARGS__), false)
#define json_fail(...) (json_fail(__VA_ARGS__), false)
#define json_fail_key(...) (json_fail_key(__VA_ARGS__), false)
