# Builds rectray, a teaching ray tracer. `make help` lists what can be made.
#
# Everything built goes under $(BUILD). Variants (sanitizers, another compiler) are this same Makefile called
# again with another BUILD and other flags: see `asan` and `clang`.

BUILD  ?= build
PREFIX ?= /usr/local

SCENE ?= scenes/cornell.json
OUT   ?= $(BUILD)/$(basename $(notdir $(SCENE))).png

# --- How to compile -------------------------------------------------------------------------------------------

CC         ?= cc
PKG_CONFIG ?= pkg-config
CFLAGS     ?= -O2 -g
# Warnings are errors. A compiler newer than ours may know new warnings: `make WERROR=` builds all the same.
WERROR     ?= -Werror
# What a variant adds to compiling and linking alike: a sanitizer, coverage.
INSTRUMENT ?=

# -ffp-contract=off: no silent fused multiply-add, so that every machine rounds alike (docs/algorithm.md).
# -fno-tree-slp-vectorize: GCC 12 at -O2 takes (double)(float)x for x in two of three neighbouring values.
STANDARD := -std=c99 -D_POSIX_C_SOURCE=200809L -DCL_TARGET_OPENCL_VERSION=120 -ffp-contract=off \
    -fno-tree-slp-vectorize
WARNINGS := -Wall -Wextra -Wpedantic -Wconversion -Wdouble-promotion -Wshadow

# pkg-config is asked when a recipe first needs its answer, not when this file is read: `make setup` may have to
# install it first. The variable then replaces itself by the answer.
LIBRARIES := libpng libisal libcjson OpenCL
LIB_CFLAGS = $(eval LIB_CFLAGS := $(shell $(PKG_CONFIG) --cflags $(LIBRARIES)))$(LIB_CFLAGS)
LIB_LIBS   = $(eval LIB_LIBS := $(shell $(PKG_CONFIG) --libs $(LIBRARIES)))$(LIB_LIBS)

# A recipe says in a word what it does, and the whole command with `make V=1`.
Q := $(if $(V),,@)
say = $(if $(V),,@printf '  %-8s %s\n' $(1) $(2))

COMPILE = $(CC) $(STANDARD) $(WARNINGS) $(WERROR) $(CFLAGS) $(INSTRUMENT) -MMD -MP -Isrc -I. $(LIB_CFLAGS) $(CPPFLAGS)
LINK    = $(CC) $(CFLAGS) $(INSTRUMENT) $(LDFLAGS)
LIBS    = $(LIB_LIBS) -lm -pthread

# --- Set-up ---------------------------------------------------------------------------------------------------

# `render`, `test` and their like begin with this: it installs what is missing, and does nothing where nothing is.
SETUP := CC="$(CC)" PKG_CONFIG="$(PKG_CONFIG)" .ci/setup

.DEFAULT_GOAL := all

.PHONY: setup
setup: ## install what building, rendering and testing need (Debian, Ubuntu)
	@$(SETUP) build run test
	@$(MAKE) --no-print-directory --silent $(UNITY_DIR)/unity.c

# A plain `make` installs nothing: it checks once, before the first object, and names what is missing.
FOUND := $(BUILD)/.libraries-found
$(FOUND):
	@$(SETUP) --check build
	@mkdir -p $(@D)
	@touch $@

# --- The program ----------------------------------------------------------------------------------------------

PROGRAM := $(BUILD)/rectray
LIBRARY := $(BUILD)/librectray.a
OBJECTS := $(patsubst src/%.c,$(BUILD)/src/%.o,$(wildcard src/*.c src/*/*.c))
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

$(BUILD)/src/%.o: src/%.c | $(FOUND)
	@mkdir -p $(@D)
	$(call say,compile,$<)
	$(Q)$(COMPILE) -c $< -o $@

$(BUILD)/kernel_sources.o: $(BUILD)/kernel_sources.c | $(FOUND)
	$(call say,compile,$<)
	$(Q)$(COMPILE) -c $< -o $@

KERNEL_FILES := $(wildcard kernels/*.cl kernels/*/*.cl kernels/*/*.h)

# The kernels inside the program: each file as an array of bytes, for C99 promises no string over 4095 characters.
$(BUILD)/kernel_sources.c: $(KERNEL_FILES) Makefile
	@mkdir -p $(@D)
	$(call say,embed,kernels/)
	@{ echo '/* Made by the Makefile from kernels/. */'; \
	   echo '#include "opencl/kernel_sources.h"'; \
	   for file in $(KERNEL_FILES); do \
	       echo "static const unsigned char $$(echo $$file | tr ./ __)[] = {"; \
	       od -An -v -tu1 $$file | sed 's/  */ /g; s/\([0-9]\) /\1, /g; s/$$/,/'; \
	       echo '0};'; \
	   done; \
	   echo 'const KernelSource kernel_sources[] = {'; \
	   for file in $(KERNEL_FILES); do \
	       array=$$(echo $$file | tr ./ __); \
	       echo "    {\"$${file#kernels/}\", (const char *)$$array, sizeof $$array - 1},"; \
	   done; \
	   echo '};'; \
	   echo 'const int kernel_source_count = $(words $(KERNEL_FILES));'; } > $@.part
	@mv $@.part $@

# --- Using it -------------------------------------------------------------------------------------------------

.PHONY: render
render: ## render SCENE (default scenes/cornell.json) to OUT (default build/NAME.png)
	@$(SETUP) build run
	@$(MAKE) --no-print-directory --silent $(PROGRAM)
	@mkdir -p $(dir $(OUT))
	$(PROGRAM) render $(SCENE) -o $(OUT)
	@echo "The picture is $(abspath $(OUT))"

.PHONY: trace
trace: ## tell step by step how PIXEL (default 320,240) of SCENE gets its colour
	@$(SETUP) build
	@$(MAKE) --no-print-directory --silent $(PROGRAM)
	$(PROGRAM) trace $(SCENE) --pixel $(PIXEL)

.PHONY: install
install: $(PROGRAM) ## install the program, the scenes and the docs under PREFIX (default /usr/local), below DESTDIR
	install -d $(DESTDIR)$(PREFIX)/bin $(DESTDIR)$(PREFIX)/share/rectray $(DESTDIR)$(PREFIX)/share/doc/rectray
	install -m 755 $(PROGRAM) $(DESTDIR)$(PREFIX)/bin/rectray
	cp -R scenes $(DESTDIR)$(PREFIX)/share/rectray/
	cp -R README.md LICENSE docs/. $(DESTDIR)$(PREFIX)/share/doc/rectray/

.PHONY: uninstall
uninstall: ## remove what install put there
	rm -rf $(DESTDIR)$(PREFIX)/bin/rectray $(DESTDIR)$(PREFIX)/share/rectray $(DESTDIR)$(PREFIX)/share/doc/rectray

# --- The tests ------------------------------------------------------------------------------------------------

UNITY_DIR ?= build/unity
suite ?= *
# What a failing suite says to run, completed by suite=NAME.
RERUN ?= make test

# As a system header, Unity may use macros that our warnings would refuse. Flushed, a test that crashes still tells
# which ones passed before it.
UNITY_FLAGS := -isystem $(UNITY_DIR) -DUNITY_INCLUDE_DOUBLE -DUNITY_SUPPORT_64 -DUNITY_USE_FLUSH_STDOUT
UNIT_TESTS   := $(patsubst tests/%.c,$(BUILD)/tests/%,$(wildcard tests/test_$(suite).c))
SCRIPT_TESTS := $(wildcard tests/$(suite)_test.py tests/$(suite)_test.sh)

.PHONY: test
test: ## run all tests, or one suite: make test suite=NAME
	@$(SETUP) build run test
	@$(MAKE) --no-print-directory --silent $(PROGRAM) $(UNIT_TESTS) \
	    $(if $(filter %/stress_test.sh,$(SCRIPT_TESTS)),$(STRESS)) $(if $(filter %/faults_test.py,$(SCRIPT_TESTS)),$(FAULTS)) \
	    $(if $(filter %/random_scenes_test.sh,$(SCRIPT_TESTS)),$(RANDOM_COMPARE))
	@RECTRAY=$(abspath $(PROGRAM)) RERUN="$(RERUN)" tests/support/run $(UNIT_TESTS) $(SCRIPT_TESTS)

.PHONY: golden
golden: $(PROGRAM) ## renew tests/golden/ and the output in docs/walkthrough.md after a change of wording
	RECTRAY=$(abspath $(PROGRAM)) python3 tests/golden_test.py --renew

$(BUILD)/tests/%.o: tests/%.c $(UNITY_DIR)/unity.c | $(FOUND)
	@mkdir -p $(@D)
	$(call say,compile,$<)
	$(Q)$(COMPILE) $(UNITY_FLAGS) -Itests -c $< -o $@

$(BUILD)/tests/test_%: $(BUILD)/tests/test_%.o $(BUILD)/tests/unity.o $(LIBRARY)
	$(call say,link,$@)
	$(Q)$(LINK) $^ $(LIBS) -o $@

FUZZ_OBJECTS := $(patsubst tests/%.c,$(BUILD)/tests/%.o,$(wildcard tests/fuzz/fuzz_*.c)) $(BUILD)/tests/fuzz/shared.o

# The exact oracle reckons in integers of any size, exact coverage in rationals.
$(BUILD)/tests/test_oracle: $(BUILD)/tests/support/oracle.o
$(BUILD)/tests/test_truth $(BUILD)/tests/test_convergence: $(BUILD)/tests/support/coverage.o $(BUILD)/tests/support/polygon.o
$(BUILD)/tests/test_oracle $(BUILD)/tests/test_truth $(BUILD)/tests/test_convergence: LIBS += -lgmp

$(BUILD)/tests/test_backends: $(BUILD)/tests/support/near_edge.o
$(BUILD)/tests/test_backends: LIBS = $(LIBRARY) $(LIB_LIBS) -lm -pthread

# The fuzzers' targets over the inputs that are kept; they too call the library.
$(BUILD)/tests/test_fuzz: $(FUZZ_OBJECTS)
$(BUILD)/tests/test_fuzz: LIBS = $(LIBRARY) $(LIB_LIBS) -lm -pthread

# What fails on command under the program: memory, OpenCL. A sanitizer looks through it for the caller.
FAULTS := $(BUILD)/faults/memory.so $(BUILD)/faults/opencl.so
$(BUILD)/faults/%.so: tests/faults/%.c
	@mkdir -p $(@D)
	$(call say,compile,$<)
	$(Q)$(CC) -std=gnu11 $(WARNINGS) $(WERROR) -O1 -g -fno-omit-frame-pointer -shared -fPIC $< -ldl -o $@

# The stress suite: `make test` runs a small part of it, `make stress` all of it.
STRESS := $(BUILD)/stress
TEST   ?=
.PHONY: stress
stress: ## try the geometry by millions of rays, judged by exact arithmetic (SEED=1 TEST=NAME SCALE=1; minutes)
	@$(SETUP) build run test
	@$(MAKE) --no-print-directory --silent $(STRESS) $(PROGRAM)
	@$(STRESS) --seed $(SEED) --scale $(SCALE) $(if $(TEST),--test $(TEST))

.PHONY: stability
stability: $(STRESS) ## the same, written as a table into docs/stability.md
	@.ci/stability $(STRESS) --seed $(SEED) --scale $(SCALE)

# Each small fault of tests/mutants/list must make a named test fail.
.PHONY: mutants
mutants: programs ## put small faults into copies of the tree: a named test must fail for each (MUTANT=NAME; minutes)
	@tests/mutants/run.py $(MUTANT)

STRESS_OBJECTS := $(patsubst tests/%.c,$(BUILD)/tests/%.o,$(wildcard tests/stress/*.c)) $(BUILD)/tests/support/oracle.o
SEED ?= 1
SCALE ?= 1

$(STRESS): $(STRESS_OBJECTS) $(LIBRARY)
	$(call say,link,$@)
	$(Q)$(LINK) $^ $(LIBS) -lgmp -o $@

$(BUILD)/tests/stress/%.o: CPPFLAGS += -Itests -I$(BUILD)/tests/stress
$(BUILD)/tests/stress/probe_sources.o: $(BUILD)/tests/stress/probe_cl.inc

$(BUILD)/tests/stress/probe_cl.inc: tests/stress/probe.cl Makefile
	@mkdir -p $(@D)
	@od -An -v -tu1 $< | sed 's/  */ /g; s/\([0-9]\) /\1, /g; s/$$/,/' > $@

$(BUILD)/tests/unity.o: $(UNITY_DIR)/unity.c
	@mkdir -p $(@D)
	$(call say,compile,$<)
	$(Q)$(CC) -std=c99 $(CFLAGS) $(INSTRUMENT) $(UNITY_FLAGS) -c $< -o $@

# What does not fit into .ci/run, for a night: the suites at length, and the programs that watch every access.
.PHONY: soak
soak: ## hours of tests: the suites at length, lint, stress, mutants, random scenes, fuzz, oclgrind, valgrind, coverage
	@RECTRAY_SOAK=1 $(MAKE) --no-print-directory test
	@$(MAKE) --no-print-directory lint stress mutants oclgrind valgrind coverage
	@$(MAKE) --no-print-directory random-scenes COUNT=10000
	@$(MAKE) --no-print-directory fuzz SECONDS=1800

.PHONY: oclgrind
oclgrind: ## run the kernels in a simulated device that watches memory and races (minutes)
	@$(SETUP) build run oclgrind
	@$(MAKE) --no-print-directory --silent $(PROGRAM)
	@tests/soak/oclgrind $(PROGRAM)

.PHONY: valgrind
valgrind: ## run the commands in valgrind: wrong accesses, what was never set, what is lost (minutes)
	@$(SETUP) build run valgrind
	@$(MAKE) --no-print-directory --silent $(PROGRAM)
	@tests/soak/valgrind $(PROGRAM)

# Random scenes on both backends: `make test` renders some, `make random-scenes` as many as you like.
RANDOM_COMPARE := $(BUILD)/compare_scenes
RANDOM_OBJECTS := $(BUILD)/tests/random/compare.o $(BUILD)/tests/support/near_edge.o
COUNT ?= 1000

.PHONY: random-scenes
random-scenes: ## render random scenes on both backends and compare (COUNT=1000 SEED=1); failing ones stay in build/
	@$(SETUP) build run test
	@$(MAKE) --no-print-directory --silent $(RANDOM_COMPARE)
	@python3 tests/random/run.py $(RANDOM_COMPARE) $(BUILD)/random-scenes $(COUNT) $(SEED)

$(RANDOM_OBJECTS): CPPFLAGS += -Itests

$(RANDOM_COMPARE): $(RANDOM_OBJECTS) $(LIBRARY)
	$(call say,link,$@)
	$(Q)$(LINK) $^ $(LIBS) -o $@

# The fuzzers: each target of tests/fuzz/ in a program of libFuzzer's, which only clang has.
FUZZERS := $(patsubst tests/fuzz/fuzz_%.c,$(BUILD)/fuzz_%,$(wildcard tests/fuzz/fuzz_*.c))
SECONDS ?= 60
TARGET  ?= *

.PHONY: fuzz
fuzz: ## throw mutated input at the readers for SECONDS each (60; TARGET=scene, obj, mtl or options)
	@$(SETUP) build clang fuzz
	@$(MAKE) --no-print-directory --silent fuzzers CC=clang BUILD=build/fuzz CFLAGS="-O1 -g -fno-omit-frame-pointer" \
	    INSTRUMENT="-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all"
	@tests/fuzz/run build/fuzz $(SECONDS) "$(TARGET)"

.PHONY: fuzzers
fuzzers: $(FUZZERS)

$(FUZZERS): $(BUILD)/fuzz_%: tests/fuzz/libfuzzer.c $(FUZZ_OBJECTS) $(LIBRARY)
	$(call say,link,$@)
	$(Q)$(COMPILE) -DTARGET=fuzz_$* -fsanitize=fuzzer $^ $(LDFLAGS) $(LIBS) -o $@

# Fetched, not kept here; a folder that UNITY_DIR names must have it.
build/unity/unity.c:
	@.ci/unity $(@D)

# --- Speed ----------------------------------------------------------------------------------------------------

# The programs that ours is measured against, or that help to: each links our library, so that it reads the same scenes.
# They are built for this machine alone, as fast as the compiler can.
PEERS := $(BUILD)/peers/embree $(BUILD)/peers/povray_export
PEER_CFLAGS := -std=gnu99 -O3 -march=native -mprefer-vector-width=512 -ffast-math $(WARNINGS)

# plots FOLDER: draws what the last `bench --ladder` measured.
plots = for plot in ladder scaling; do gnuplot -e "folder='build/bench'; out='$(1)'" docs/plots/$$plot.gp; done

.PHONY: bench
bench: ## measure the ladder of scenes: tables here, plots in build/bench/ (many minutes)
	@$(SETUP) build run bench
	@$(MAKE) --no-print-directory --silent $(PROGRAM)
	$(PROGRAM) bench --ladder --folder build/bench
	@$(call plots,build/bench)

.PHONY: bench-peers
bench-peers: peers ## the same beside Embree and POV-Ray: renews docs/performance.md and its plots
	@$(SETUP) build run bench peers
	$(PROGRAM) bench --ladder --folder build/bench -o docs/performance.md
	@$(call plots,docs/images)

.PHONY: bench-error
bench-error: ## time against error, of the ladder's small scenes: renews docs/accuracy.md and its plots (minutes)
	@$(SETUP) build run bench
	@$(MAKE) --no-print-directory --silent $(PROGRAM)
	$(PROGRAM) bench error --ladder --folder build/bench --repeats 3 -o docs/accuracy.md
	@for scene in original cornell mirrors gallery menger-2 city-1k; do \
	    gnuplot -e "folder='build/bench'; out='docs/images'; scene='$$scene'" docs/plots/error.gp; \
	done

.PHONY: peers
peers: ## build the programs of tests/peers/ that ours is measured against
	@$(SETUP) build peers
	@$(MAKE) --no-print-directory --silent $(PROGRAM) $(PEERS)

$(BUILD)/peers/%: tests/peers/%.c $(wildcard tests/peers/peer_*.[ch]) $(LIBRARY)
	@mkdir -p $(@D)
	$(call say,compile,$<)
	$(Q)$(CC) $(PEER_CFLAGS) $(WERROR) -Isrc -I. $< $(PEER_SOURCES) $(LIBRARY) $(PEER_LIBS) $(LIBS) -o $@

$(BUILD)/peers/embree: PEER_SOURCES := $(wildcard tests/peers/peer_*.c)
$(BUILD)/peers/embree: PEER_LIBS := -lembree3

# --- Variants and care ----------------------------------------------------------------------------------------

# Every test again with each memory access and each undefined operation watched. What the OpenCL driver itself
# leaks is none of ours: tests/support/lsan.supp.
.PHONY: asan
asan: ## run the tests under AddressSanitizer and UndefinedBehaviorSanitizer (suite=NAME too)
	@ASAN_OPTIONS=$${ASAN_OPTIONS:-detect_stack_use_after_return=1} UBSAN_OPTIONS=$${UBSAN_OPTIONS:-print_stacktrace=1} \
	 LSAN_OPTIONS=suppressions=$(abspath tests/support/lsan.supp):print_suppressions=0 \
	 $(MAKE) --no-print-directory test BUILD=build/asan RERUN="make asan" CFLAGS="-O1 -g -fno-omit-frame-pointer" \
	     INSTRUMENT="-fsanitize=address,undefined -fno-sanitize-recover=all"

# Branches are told, too. umask 0: a test becomes another user, who counts as well.
.PHONY: coverage
coverage: ## run the tests and tell which lines of src/ they reach: 95 % at least (suite=NAME too)
	@$(SETUP) coverage
	@find build/coverage -name '*.gcda' -delete 2>/dev/null || true
	@umask 0 && $(MAKE) --no-print-directory test BUILD=build/coverage RERUN="make coverage" CFLAGS="-O0 -g" \
	     INSTRUMENT="--coverage -fprofile-update=atomic"
	@gcovr --root . --filter src/ --print-summary --fail-under-line 95 build/coverage

.PHONY: clang
clang: ## build the program and its tests with clang, warnings being errors
	@$(SETUP) clang build
	@$(MAKE) --no-print-directory programs CC=clang BUILD=build/clang

.PHONY: programs
programs: $(PROGRAM) $(UNIT_TESTS) $(STRESS) $(FAULTS) $(RANDOM_COMPARE)

.PHONY: format
format: ## give the C sources the style of .clang-format
	clang-format -i $(wildcard src/*.[ch] src/*/*.[ch] tests/support/*.[ch] tests/*.[ch] tests/stress/*.[ch] tests/fuzz/*.[ch] tests/random/*.[ch])

.PHONY: lint
lint: ## look for likely mistakes with clang-tidy (.clang-tidy) and cppcheck
	@.ci/setup --check lint
	@$(MAKE) --no-print-directory --silent $(FOUND)
	@for file in $(wildcard src/*.c src/*/*.c); do \
	    case $$file in src/base/error.c|src/json/json.c) hint= ;; *) hint="-include .ci/lint.h" ;; esac; \
	    clang-tidy --quiet --warnings-as-errors='*' $$file -- $(STANDARD) -Isrc -I. $(LIB_CFLAGS) $$hint 2>$(BUILD)/lint.log || \
	        failed=yes; \
	done; \
	test -z "$$failed"
	cppcheck --quiet --std=c99 --enable=warning,performance,portability --inline-suppr --error-exitcode=1 \
	    --suppress=missingIncludeSystem -Isrc -I. -D_POSIX_C_SOURCE=200809L src

.PHONY: clean
clean: ## remove everything that was built
	rm -rf build

.PHONY: help
help: ## this list
	@echo "Usage: make [TARGET] [VARIABLE=VALUE]... (V=1 shows the commands, WERROR= forgives warnings)"
	@sed -n 's/^\([a-z-]*\):.*## /    make \1\t/p' Makefile | expand -t 22

.DELETE_ON_ERROR:
.SECONDARY:

-include $(OBJECTS:.o=.d) $(STRESS_OBJECTS:.o=.d) $(FUZZ_OBJECTS:.o=.d) $(RANDOM_OBJECTS:.o=.d) $(patsubst tests/%.c,$(BUILD)/tests/%.d,$(wildcard tests/test_*.c))
