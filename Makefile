# Builds rectray, a teaching ray tracer. `make help` lists what can be made.
#
# Everything built goes under $(BUILD). Variants (sanitizers, another compiler) are this same Makefile called
# again with another BUILD and other flags: see `asan` and `clang`.

BUILD  ?= build
PREFIX ?= /usr/local

SCENE ?= scenes/cornell.json
OUT   ?= $(BUILD)/$(basename $(notdir $(SCENE))).png
PIXEL ?= 320,240

# --- How to compile -------------------------------------------------------------------------------------------

CC         ?= cc
PKG_CONFIG ?= pkg-config
CFLAGS     ?= -O2 -g
# Warnings are errors. A compiler newer than ours may know new warnings: `make WERROR=` builds all the same.
WERROR     ?= -Werror
# What a variant adds to compiling and linking alike: a sanitizer, coverage.
INSTRUMENT ?=

# -ffp-contract=off: no silent fused multiply-add, so that every machine rounds alike (docs/).
STANDARD := -std=c99 -D_POSIX_C_SOURCE=200809L -DCL_TARGET_OPENCL_VERSION=120 -ffp-contract=off
WARNINGS := -Wall -Wextra -Wpedantic -Wconversion -Wdouble-promotion -Wshadow

# pkg-config is asked when a recipe first needs its answer, not when this file is read: `make setup` may have to
# install it first. The variable then replaces itself by the answer.
LIBRARIES := libpng libcjson OpenCL
LIB_CFLAGS = $(eval LIB_CFLAGS := $(shell $(PKG_CONFIG) --cflags $(LIBRARIES)))$(LIB_CFLAGS)
LIB_LIBS   = $(eval LIB_LIBS := $(shell $(PKG_CONFIG) --libs $(LIBRARIES)))$(LIB_LIBS)

# A recipe says in a word what it does, and the whole command with `make V=1`.
Q := $(if $(V),,@)
say = $(if $(V),,@printf '  %-8s %s\n' $(1) $(2))

COMPILE = $(CC) $(STANDARD) $(WARNINGS) $(WERROR) $(CFLAGS) $(INSTRUMENT) -MMD -MP -Isrc $(LIB_CFLAGS) $(CPPFLAGS)
LINK    = $(CC) $(CFLAGS) $(INSTRUMENT) $(LDFLAGS)
LIBS    = $(LIB_LIBS) -lm -pthread

# --- The program ----------------------------------------------------------------------------------------------

# The kernel sources in the order in which OpenCL compiles them, as one program.
KERNELS := layout.h lanes.cl exact.cl geometry.cl trace.cl shade.cl render.cl

PROGRAM := $(BUILD)/rectray
LIBRARY := $(BUILD)/librectray.a
OBJECTS := $(patsubst src/%.c,$(BUILD)/src/%.o,$(wildcard src/*.c))
LIBRARY_OBJECTS := $(filter-out %/main.o,$(OBJECTS)) $(BUILD)/kernel_sources.o

.PHONY: all
all: $(PROGRAM) ## build build/rectray (the default)

$(PROGRAM): $(BUILD)/src/main.o $(LIBRARY)
	$(call say,link,$@)
	$(Q)$(LINK) $^ $(LIBS) -o $@

# Made anew each time, so that it never keeps the object of a source that is gone.
$(LIBRARY): $(LIBRARY_OBJECTS)
	$(call say,archive,$@)
	$(Q)rm -f $@
	$(Q)$(AR) rcs $@ $^

$(BUILD)/src/%.o: src/%.c | libraries
	@mkdir -p $(@D)
	$(call say,compile,$<)
	$(Q)$(COMPILE) -c $< -o $@

$(BUILD)/kernel_sources.o: $(BUILD)/kernel_sources.c | libraries
	$(call say,compile,$<)
	$(Q)$(COMPILE) -c $< -o $@

KERNEL_FILES := $(wildcard $(addprefix kernels/,$(KERNELS)))

# The kernels inside the program: each file as an array of bytes, for C99 promises no string over 4095 characters.
$(BUILD)/kernel_sources.c: $(KERNEL_FILES) Makefile
	@mkdir -p $(@D)
	$(call say,embed,kernels/)
	@{ echo '/* Made by the Makefile from kernels/. */'; \
	   echo '#include "kernel_sources.h"'; \
	   for file in $(KERNEL_FILES); do \
	       echo "static const unsigned char $$(basename $$file | tr . _)[] = {"; \
	       od -An -v -tu1 $$file | sed 's/  */ /g; s/\([0-9]\) /\1, /g; s/$$/,/'; \
	       echo '0};'; \
	   done; \
	   echo 'const KernelSource kernel_sources[] = {'; \
	   for file in $(KERNEL_FILES); do \
	       name=$$(basename $$file); array=$$(echo $$name | tr . _); \
	       echo "    {\"$$name\", (const char *)$$array, sizeof $$array - 1},"; \
	   done; \
	   echo '    {0, 0, 0}};'; \
	   echo 'const int kernel_source_count = $(words $(KERNEL_FILES));'; } > $@.part
	@mv $@.part $@

# --- The tests ------------------------------------------------------------------------------------------------

UNITY_DIR ?= build/unity
suite ?= *

UNITY_FLAGS := -isystem $(UNITY_DIR) -DUNITY_INCLUDE_DOUBLE -DUNITY_SUPPORT_64
UNIT_TESTS   := $(patsubst tests/%.c,$(BUILD)/tests/%,$(wildcard tests/test_$(suite).c))
SCRIPT_TESTS := $(wildcard tests/$(suite)_test.py tests/$(suite)_test.sh)

.PHONY: test
test: ## run all tests, or one suite: make test suite=NAME
	@$(MAKE) --no-print-directory --silent $(PROGRAM) $(UNIT_TESTS)
	@RECTRAY=$(abspath $(PROGRAM)) tests/run $(UNIT_TESTS) $(SCRIPT_TESTS)

$(BUILD)/tests/%.o: tests/%.c $(UNITY_DIR)/unity.c | libraries
	@mkdir -p $(@D)
	$(call say,compile,$<)
	$(Q)$(COMPILE) $(UNITY_FLAGS) -c $< -o $@

$(BUILD)/tests/test_%: $(BUILD)/tests/test_%.o $(BUILD)/tests/unity.o $(LIBRARY)
	$(call say,link,$@)
	$(Q)$(LINK) $^ $(LIBS) -o $@

$(BUILD)/tests/unity.o: $(UNITY_DIR)/unity.c
	@mkdir -p $(@D)
	$(call say,compile,$<)
	$(Q)$(CC) -std=c99 $(CFLAGS) $(INSTRUMENT) $(UNITY_FLAGS) -c $< -o $@

build/unity/unity.c:
	.ci/unity $(@D)

.PHONY: libraries
libraries:

.PHONY: clean
clean: ## remove everything that was built
	rm -rf build

.PHONY: help
help: ## this list
	@sed -n 's/^\([a-z-]*\):.*## /    make \1\t/p' Makefile | expand -t 20

.DELETE_ON_ERROR:
.SECONDARY:

-include $(OBJECTS:.o=.d) $(patsubst tests/%.c,$(BUILD)/tests/%.d,$(wildcard tests/test_*.c))
