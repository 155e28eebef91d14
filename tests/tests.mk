# How the tests are built, and what renews the texts that they compare with. A suite is a file at the top of tests/:
# test_NAME.c (Unity), NAME_test.py or NAME_test.sh. To add one, add the file. What several suites share lies in
# tests/support/; a suite that needs an object of it gets a line under "Suites" below.
# `make test` itself stands in the Makefile, which includes this file.

# --- Which suites ---------------------------------------------------------------------------------------------

UNIT_TESTS   := $(patsubst tests/%.c,$(BUILD)/tests/%,$(wildcard tests/test_$(suite).c))
SCRIPT_TESTS := $(wildcard tests/$(suite)_test.py tests/$(suite)_test.sh)

STRESS         := $(BUILD)/stress
FAULTS         := $(BUILD)/faults/memory.so $(BUILD)/faults/opencl.so
SHIM           := $(BUILD)/shims/opencl_device.so
RANDOM_COMPARE := $(BUILD)/compare_scenes

# Programs that a script runs beside rectray.
SCRIPT_TEST_PROGRAMS := $(if $(filter %/stress_test.sh,$(SCRIPT_TESTS)),$(STRESS)) \
    $(if $(filter %/faults_test.py,$(SCRIPT_TESTS)),$(FAULTS)) \
    $(if $(filter %/devices_test.py %/gpu_check_test.py,$(SCRIPT_TESTS)),$(SHIM)) \
    $(if $(filter %/devices_test.py,$(SCRIPT_TESTS)),$(STRESS)) \
    $(if $(filter %/random_scenes_test.sh,$(SCRIPT_TESTS)),$(RANDOM_COMPARE))

STRESS_OBJECTS := $(patsubst tests/%.c,$(BUILD)/tests/%.o,$(wildcard tests/stress/*.c)) $(BUILD)/tests/support/oracle.o
FUZZ_OBJECTS   := $(patsubst tests/%.c,$(BUILD)/tests/%.o,$(wildcard tests/fuzz/fuzz_*.c)) $(BUILD)/tests/fuzz/shared.o
RANDOM_OBJECTS := $(BUILD)/tests/random/compare.o $(BUILD)/tests/support/near_edge.o

# --- Unity ----------------------------------------------------------------------------------------------------

UNITY_DIR ?= build/unity

# As a system header, Unity may use macros that our warnings would refuse. Flushed, a test that crashes still tells
# which ones passed before it.
UNITY_FLAGS := -isystem $(UNITY_DIR) -DUNITY_INCLUDE_DOUBLE -DUNITY_SUPPORT_64 -DUNITY_USE_FLUSH_STDOUT

# Fetched, not kept here; a folder that UNITY_DIR names must have it.
build/unity/unity.c:
	@.ci/unity $(@D)

$(BUILD)/tests/unity.o: $(UNITY_DIR)/unity.c
	@mkdir -p $(@D)
	$(call say,compile,$<)
	$(Q)$(CC) -std=c99 $(CFLAGS) $(INSTRUMENT) $(UNITY_FLAGS) -c $< -o $@

# --- Suites ---------------------------------------------------------------------------------------------------

$(BUILD)/tests/%.o: tests/%.c $(UNITY_DIR)/unity.c | $(FOUND)
	@mkdir -p $(@D)
	$(call say,compile,$<)
	$(Q)$(COMPILE) $(UNITY_FLAGS) -Itests -c $< -o $@

$(BUILD)/tests/test_%: $(BUILD)/tests/test_%.o $(BUILD)/tests/unity.o $(LIBRARY)
	$(call say,link,$@)
	$(Q)$(LINK) $^ $(LIBS) -o $@

# The exact oracle reckons in integers of any size, exact coverage in rationals.
$(BUILD)/tests/test_oracle: $(BUILD)/tests/support/oracle.o
$(BUILD)/tests/test_truth $(BUILD)/tests/test_convergence: $(patsubst %,$(BUILD)/tests/support/%.o,coverage polygon)
$(BUILD)/tests/test_polygon_cut: $(patsubst %,$(BUILD)/tests/support/%.o,polygon random_polygon)
$(BUILD)/tests/test_scene_polygon: $(patsubst %,$(BUILD)/tests/support/%.o,coverage polygon random_polygon)
$(patsubst %,$(BUILD)/tests/test_%,oracle truth convergence polygon_cut scene_polygon): LIBS += -lgmp

$(patsubst %,$(BUILD)/tests/test_%,backends plain gpu): $(BUILD)/tests/support/near_edge.o
$(patsubst %,$(BUILD)/tests/test_%,plain gpu gpu_adaptive textbook): $(BUILD)/tests/support/plain_picture.o
$(patsubst %,$(BUILD)/tests/test_%,backends plain gpu gpu_adaptive textbook): LIBS = $(LIBRARY) $(LIB_LIBS) -lm -pthread

$(patsubst %,$(BUILD)/tests/test_%,pairs pair_signs): $(BUILD)/tests/support/pair_kernels.o
$(patsubst %,$(BUILD)/tests/test_%,pairs pair_signs): LIBS = $(LIBRARY) $(LIB_LIBS) -lm -pthread -lgmp

$(BUILD)/tests/test_bvh: $(BUILD)/tests/support/plain_bvh.o

# The fuzzers' targets over the inputs that are kept; they too call the library.
$(BUILD)/tests/test_fuzz: $(FUZZ_OBJECTS)
$(BUILD)/tests/test_fuzz: LIBS = $(LIBRARY) $(LIB_LIBS) -lm -pthread

# What fails on command under the program: memory, OpenCL. A sanitizer looks through it for the caller.
PRELOADED = $(CC) -std=gnu11 $(WARNINGS) $(WERROR) -O1 -g -fno-omit-frame-pointer -shared -fPIC

$(BUILD)/faults/%.so: tests/faults/%.c
	@mkdir -p $(@D)
	$(call say,compile,$<)
	$(Q)$(PRELOADED) $< -ldl -o $@

# A device that poses as another under the program.
$(BUILD)/shims/%.so: tests/shims/%.c
	@mkdir -p $(@D)
	$(call say,compile,$<)
	$(Q)$(PRELOADED) $< -ldl -o $@

# --- Stress: `make test` runs a small part of it, `make stress` all of it -------------------------------------

$(STRESS): $(STRESS_OBJECTS) $(LIBRARY)
	$(call say,link,$@)
	$(Q)$(LINK) $^ $(LIBS) -lgmp -o $@

$(BUILD)/tests/stress/%.o: CPPFLAGS += -Itests -I$(BUILD)/tests/stress
$(BUILD)/tests/stress/probe_sources.o: $(patsubst %,$(BUILD)/tests/stress/%_cl.inc,probe probe_pairs)

$(BUILD)/tests/stress/%_cl.inc: tests/stress/%.cl
	@mkdir -p $(@D)
	@od -An -v -tu1 $< | sed 's/  */ /g; s/\([0-9]\) /\1, /g; s/$$/,/' > $@

# --- Random scenes on both backends: `make test` renders some, this as many as you like -------------------------

COUNT ?= 1000

.PHONY: random-scenes
random-scenes: ## render random scenes on both backends and compare (COUNT=1000 SEED=1 KERNEL=plain or gpu)
	@$(SETUP) build run test
	@$(MAKE) --no-print-directory --silent $(RANDOM_COMPARE)
	@python3 tests/random/run.py $(RANDOM_COMPARE) $(BUILD)/random-scenes $(COUNT) $(SEED) $(KERNEL)

$(RANDOM_OBJECTS): CPPFLAGS += -Itests

$(RANDOM_COMPARE): $(RANDOM_OBJECTS) $(LIBRARY)
	$(call say,link,$@)
	$(Q)$(LINK) $^ $(LIBS) -o $@

# --- Another driver -------------------------------------------------------------------------------------------

# The suites that render. Intel's compiler takes its time with the kernels: minutes where nothing is kept.
DRIVER_SUITES ?= backends cast commands determinism
INTEL          = OCL_ICD_VENDORS=$(abspath build/icd)

.PHONY: test-opencl
test-opencl: ## run the suites that render on Intel's CPU runtime, fetched into build/ under its licence (225 MB)
	@$(SETUP) build run test
	@.ci/intel
	@$(MAKE) --no-print-directory --silent $(PROGRAM)
	@$(INTEL) $(PROGRAM) devices
	@$(foreach one,$(DRIVER_SUITES),$(INTEL) $(MAKE) --no-print-directory --silent test suite=$(one) \
	    RERUN="make test-opencl DRIVER_SUITES=$(one)" &&) :

# --- Texts that are renewed -----------------------------------------------------------------------------------

.PHONY: golden
golden: $(PROGRAM) ## renew tests/golden/ and the output in docs/walkthrough.md and rounding.md
	RECTRAY=$(abspath $(PROGRAM)) python3 tests/golden_test.py --renew

.PHONY: stability
stability: $(STRESS) ## the stress suite, written as a table into docs/stability.md
	@.ci/stability $(STRESS) --seed $(SEED) --scale $(SCALE)

-include $(STRESS_OBJECTS:.o=.d) $(FUZZ_OBJECTS:.o=.d) $(RANDOM_OBJECTS:.o=.d)
-include $(patsubst tests/%.c,$(BUILD)/tests/%.d,$(wildcard tests/test_*.c tests/support/*.c))
