# What watches the tests and the sources: sanitizers, another compiler, mutants, fuzzers, simulated devices, lint.
# The Makefile includes this file. The variants call it again with another BUILD and other flags.

# --- Variants -------------------------------------------------------------------------------------------------

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
programs: $(PROGRAM) $(UNIT_TESTS) $(STRESS) $(FAULTS) $(SHIM) $(RANDOM_COMPARE)

# --- Faults and inputs nobody thought of ------------------------------------------------------------------------

# Each small fault of tests/mutants/list must make a named test fail.
.PHONY: mutants
mutants: programs ## put small faults into copies of the tree: a named test must fail for each (MUTANT=NAME; minutes)
	@tests/mutants/run.py $(MUTANT)

# The fuzzers: each target of tests/fuzz/ in a program of libFuzzer's, which only clang has.
FUZZERS := $(patsubst tests/fuzz/fuzz_%.c,$(BUILD)/fuzz_%,$(wildcard tests/fuzz/fuzz_*.c))
SECONDS ?= 60
TARGET  ?= *

.PHONY: fuzz
fuzz: ## throw mutated input at the readers for SECONDS each (60; TARGET=model, scene and their like)
	@$(SETUP) build clang fuzz
	@$(MAKE) --no-print-directory --silent fuzzers CC=clang BUILD=build/fuzz CFLAGS="-O1 -g -fno-omit-frame-pointer" \
	    INSTRUMENT="-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all"
	@tests/fuzz/run build/fuzz $(SECONDS) "$(TARGET)"

.PHONY: fuzzers
fuzzers: $(FUZZERS)

$(FUZZERS): $(BUILD)/fuzz_%: tests/fuzz/libfuzzer.c $(FUZZ_OBJECTS) $(LIBRARY)
	$(call say,link,$@)
	$(Q)$(COMPILE) -DTARGET=fuzz_$* -fsanitize=fuzzer $^ $(LDFLAGS) $(LIBS) -o $@

# --- Editors ----------------------------------------------------------------------------------------------------

# What VS Code, Neovim and Emacs run, for tests/editor_test.py: Node.js and 100 MB from npm, nothing outside build/.
.PHONY: language-server
language-server: build/language-server/node_modules ## install a JSON language server in build/: make test suite=editor

build/language-server/node_modules:
	npm install --prefix $(@D) --no-audit --no-fund --loglevel=error vscode-langservers-extracted@4.10.0

# --- Every access watched, for a night ------------------------------------------------------------------------

# What does not fit into .ci/run, for a night: the suites at length, and the programs that watch every access.
.PHONY: soak
soak: ## hours of tests: the suites at length, lint, stress, mutants, random scenes, fuzz, oclgrind, valgrind, coverage
	@RECTRAY_SOAK=1 $(MAKE) --no-print-directory test
	@$(MAKE) --no-print-directory lint stress mutants oclgrind valgrind coverage test-deb test-cluster
	@SHIM_NO_DOUBLE=1 LD_PRELOAD=$(abspath $(SHIM)) $(STRESS) --scale 0.1 2>/dev/null
	@$(MAKE) --no-print-directory random-scenes COUNT=10000
	@tests/soak/grade_mutants.py
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

# --- Many machines --------------------------------------------------------------------------------------------

.PHONY: test-cluster
test-cluster: ## run the scripts of docs/cluster/ on Slurm and GNU parallel of this machine alone; nodes die (a minute)
	@$(SETUP) build run test
	@$(SETUP) cluster || true
	@$(MAKE) --no-print-directory --silent $(PROGRAM)
	@python3 -B tests/cluster/run $(PROGRAM)

# --- Style and likely mistakes --------------------------------------------------------------------------------

.PHONY: format
format: ## give the C sources of src/ and tests/ the style of .clang-format
	clang-format -i $$(find src tests -name '*.[ch]')

# The style alone is a suite of its own, which takes a second: make test suite=style.
.PHONY: lint
lint: ## look for likely mistakes: the style, clang-tidy (.clang-tidy), cppcheck (minutes)
	@$(SETUP) build lint
	python3 tests/style_test.py
	@echo "clang-tidy on each source of src/"
	@printf '%s\n' $(wildcard src/*.c src/*/*.c) | \
	    xargs -P "$$(nproc)" -I {} .ci/tidy {} $(STANDARD) -Isrc -I. $(LIB_CFLAGS)
	cppcheck --quiet --std=c99 --enable=warning,performance,portability --inline-suppr --error-exitcode=1 \
	    --suppress=missingIncludeSystem -Isrc -I. -D_POSIX_C_SOURCE=200809L src
