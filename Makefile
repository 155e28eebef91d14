# Builds rectray, a teaching ray tracer. `make help` lists what can be made.
#
# This file is what a user needs. What stands beside it is included at its end: tests/tests.mk builds the suites,
# .ci/care.mk has sanitizers, mutants, fuzzers and lint, .ci/package.mk the archive and the Debian packages,
# tests/peers/peers.mk the programs that we measure against.
#
# Everything built goes under $(BUILD). Variants (sanitizers, another compiler) are this same Makefile called
# again with another BUILD and other flags: see `asan` and `clang` in .ci/care.mk.

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
# The objects of the program are those of the libraries, too.
STANDARD += -fPIC -fvisibility=hidden
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

# For $(MAKE): on all processors, or on as many as -j says, and without its own words.
CORES = $(shell nproc 2>/dev/null || getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1)
ALL_CORES = --no-print-directory $(if $(V),,--silent) $(if $(findstring -j,$(MAKEFLAGS)),,-j$(CORES))

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
LIBRARY := $(BUILD)/rectray-parts.a
API     := 1
OBJECTS := $(patsubst src/%.c,$(BUILD)/src/%.o,$(wildcard src/*.c src/*/*.c))
LIBRARY_OBJECTS := $(filter-out %/main.o,$(OBJECTS)) $(BUILD)/kernel_sources.o $(BUILD)/page_template.o

.PHONY: all
all: ## build build/rectray, on all processors (the default)
	@$(MAKE) $(ALL_CORES) $(PROGRAM)

$(PROGRAM): $(BUILD)/src/main.o $(LIBRARY)
	$(call say,link,$@)
	$(Q)$(LINK) $^ $(LIBS) -o $@

# Made anew each time, so that it never keeps the object of a source that is gone.
$(LIBRARY): $(LIBRARY_OBJECTS)
	$(call say,archive,$@)
	$(Q)rm -f $@
	$(Q)$(AR) rcs $@ $^

# rectray as a library, static and shared. In the static one the names that are not public are made local.
PUBLIC_OBJECTS := $(filter-out $(BUILD)/src/main.o $(BUILD)/src/command/% $(BUILD)/src/bench/% $(BUILD)/src/page/% \
    $(BUILD)/src/grade/%, $(OBJECTS)) $(BUILD)/kernel_sources.o

.PHONY: library
library: $(BUILD)/lib/librectray.a $(BUILD)/lib/librectray.so ## build librectray.a and librectray.so in build/lib

$(BUILD)/lib/librectray.so: $(PUBLIC_OBJECTS) src/library/public
	@mkdir -p $(@D)
	$(call say,link,$@)
	$(Q)$(LINK) -shared -Wl,-soname,librectray.so.$(API) -Wl,--version-script=src/library/public \
	    $(filter %.o,$^) $(LIBS) -o $@

$(BUILD)/lib/librectray.a: $(PUBLIC_OBJECTS)
	@mkdir -p $(@D)
	$(call say,archive,$@)
	$(Q)$(LD) -r $^ -o $(BUILD)/lib/rectray.o
	$(Q)objcopy -w --keep-global-symbol='rectray_*' $(BUILD)/lib/rectray.o
	$(Q)rm -f $@
	$(Q)$(AR) rcs $@ $(BUILD)/lib/rectray.o

# The flags stand in this file: where it has changed, older objects may not fit the newer ones.
$(BUILD)/src/%.o: src/%.c Makefile | $(FOUND)
	@mkdir -p $(@D)
	$(call say,compile,$<)
	$(Q)$(COMPILE) -c $< -o $@

# `rectray --version` names the commit where there is one. Its object is made anew when that changes.
VERSION := $(shell sed -n 's/^.define RECTRAY_VERSION "\(.*\)"/\1/p' src/command/usage.h)
COMMIT  := $(shell git describe --always --dirty --abbrev=10 2>/dev/null)
$(BUILD)/src/command/usage.o: CPPFLAGS += -DRECTRAY_COMMIT='"$(COMMIT)"'
$(BUILD)/src/command/usage.o: $(BUILD)/.commit-$(COMMIT)
$(BUILD)/.commit-$(COMMIT):
	@mkdir -p $(@D)
	@rm -f $(BUILD)/.commit-*
	@touch $@

# Loops that are there to become vector instructions; nobody asks sqrt for errno.
$(BUILD)/src/scene/face_lanes.o $(BUILD)/src/opencl/device_faces.o: CFLAGS += -O3 -fno-math-errno

$(BUILD)/kernel_sources.o: $(BUILD)/kernel_sources.c Makefile | $(FOUND)
	$(call say,compile,$<)
	$(Q)$(COMPILE) -c $< -o $@

KERNEL_FILES := $(wildcard kernels/*.cl kernels/*/*.cl kernels/*/*.h)

# The kernels inside the program.
$(BUILD)/kernel_sources.c: kernels/embed.sh $(KERNEL_FILES)
	@mkdir -p $(@D)
	$(call say,embed,kernels/)
	$(Q)sh kernels/embed.sh $(KERNEL_FILES) >$@

# --- Using it -------------------------------------------------------------------------------------------------

.PHONY: render
render: ## render SCENE (default scenes/cornell.json) to OUT (default build/NAME.png)
	@$(SETUP) build run
	@$(MAKE) $(ALL_CORES) $(PROGRAM)
	@mkdir -p $(dir $(OUT))
	$(PROGRAM) render $(SCENE) -o $(OUT)
	@echo "The picture is $(abspath $(OUT))"

.PHONY: trace
trace: ## tell step by step how PIXEL (default 320,240) of SCENE gets its colour
	@$(SETUP) build
	@$(MAKE) $(ALL_CORES) $(PROGRAM)
	$(PROGRAM) trace $(SCENE) --pixel $(PIXEL)

LIBDIR ?= $(PREFIX)/lib
LIB    := $(DESTDIR)$(LIBDIR)
SHARE  := $(DESTDIR)$(PREFIX)/share
MAN1   := $(SHARE)/man/man1
COMMANDS = $(shell $(PROGRAM) help | sed -n 's/^  \([a-z]*\) .*/\1/p')

.PHONY: install
install: $(PROGRAM) library ## install program, library, manual, scenes, kernels and docs under PREFIX (/usr/local)
	install -d $(DESTDIR)$(PREFIX)/bin $(SHARE)/rectray $(SHARE)/doc/rectray $(MAN1) $(SHARE)/man/man5 \
	    $(SHARE)/bash-completion/completions $(SHARE)/zsh/site-functions $(SHARE)/fish/vendor_completions.d
	install -m 755 $(PROGRAM) $(DESTDIR)$(PREFIX)/bin/rectray
	install -d $(LIB)/pkgconfig $(DESTDIR)$(PREFIX)/include
	install -m 644 src/library/rectray.h $(DESTDIR)$(PREFIX)/include/
	install -m 644 $(BUILD)/lib/librectray.a $(LIB)/
	install -m 755 $(BUILD)/lib/librectray.so $(LIB)/librectray.so.$(API)
	ln -sf librectray.so.$(API) $(LIB)/librectray.so
	sed 's|@PREFIX@|$(PREFIX)|; s|@LIBDIR@|$(LIBDIR)|; s|@VERSION@|$(VERSION)|; s|@LIBS@|$(LIBS)|' \
	    src/library/rectray.pc.in >$(LIB)/pkgconfig/rectray.pc
	cp -R scenes kernels $(SHARE)/rectray/
	cp -R README.md CONTRIBUTING.md LICENSE docs $(wildcard $(PAGE)) $(SHARE)/doc/rectray/
	$(PROGRAM) help --as man >$(MAN1)/rectray.1
	for name in $(COMMANDS); do $(PROGRAM) help $$name --as man >$(MAN1)/rectray-$$name.1 || exit 1; done
	install -m 644 docs/rectray-scene.5 $(SHARE)/man/man5/
	$(PROGRAM) help --as bash >$(SHARE)/bash-completion/completions/rectray
	$(PROGRAM) help --as zsh >$(SHARE)/zsh/site-functions/_rectray
	$(PROGRAM) help --as fish >$(SHARE)/fish/vendor_completions.d/rectray.fish

.PHONY: uninstall
uninstall: ## remove what install put there
	rm -rf $(LIB)/librectray.* $(LIB)/pkgconfig/rectray.pc \
	    $(DESTDIR)$(PREFIX)/include/rectray.h $(DESTDIR)$(PREFIX)/bin/rectray $(SHARE)/rectray $(SHARE)/doc/rectray \
	    $(MAN1)/rectray.1 $(MAN1)/rectray-*.1 \
	    $(SHARE)/man/man5/rectray-scene.5 $(SHARE)/bash-completion/completions/rectray \
	    $(SHARE)/zsh/site-functions/_rectray $(SHARE)/fish/vendor_completions.d/rectray.fish

# --- Trying and measuring it ----------------------------------------------------------------------------------

# The programs below are built by tests/tests.mk.
suite ?= *
# What a failing suite says to run, completed by suite=NAME.
RERUN ?= make test

.PHONY: test
test: ## run all tests, or one suite: make test suite=NAME
	@$(SETUP) build run test
	@$(if $(PAGE_TO_TEST),$(MAKE) --no-print-directory --silent $(PAGE_TO_TEST))
	@$(MAKE) $(ALL_CORES) $(PROGRAM) $(UNIT_TESTS) $(SCRIPT_TEST_PROGRAMS)
	@RECTRAY=$(abspath $(PROGRAM)) RERUN="$(RERUN)" tests/support/run $(UNIT_TESTS) $(SCRIPT_TESTS)

SEED  ?= 1
SCALE ?= 1
TEST  ?=

.PHONY: stress
stress: ## try the geometry by millions of rays, judged by exact arithmetic (SEED=1 TEST=NAME SCALE=1; minutes)
	@$(SETUP) build run test
	@$(MAKE) $(ALL_CORES) $(STRESS) $(PROGRAM)
	@$(STRESS) --seed $(SEED) --scale $(SCALE) $(if $(TEST),--test $(TEST))

# $(call plots,FOLDER) draws there what the last `bench --ladder` measured.
plots = for plot in ladder scaling process; do gnuplot -e "folder='build/bench'; out='$(1)'" docs/plots/$$plot.gp; done

.PHONY: bench
bench: ## measure the ladder of scenes: tables here, plots in build/bench/ (many minutes)
	@$(SETUP) build run bench
	@$(MAKE) $(ALL_CORES) $(PROGRAM)
	$(PROGRAM) bench --ladder --folder build/bench
	@$(call plots,build/bench)

# --- The rest -------------------------------------------------------------------------------------------------

PARTS := src/page/page.mk tests/tests.mk tests/exercises/exercises.mk tests/exercises/course.mk .ci/care.mk \
    .ci/package.mk tests/gpu/gpu.mk tests/peers/peers.mk
include $(PARTS)

.PHONY: clean
clean: ## remove everything that was built
	rm -rf build

.PHONY: help
help: ## this list
	@echo "Usage: make [TARGET] [VARIABLE=VALUE]... (V=1 shows the commands, WERROR= forgives warnings)"
	@sed -n 's/^\([a-z-]*\):.*## /    make \1\t/p' Makefile $(PARTS) | expand -t 24

.DELETE_ON_ERROR:
.SECONDARY:

-include $(OBJECTS:.o=.d)
