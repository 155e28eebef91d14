# The web page: the tracer as a WebAssembly module in one HTML file that opens from a folder. docs/page.md describes it.
# The Makefile includes this file. `make page` comes first; a program that is built after it can do `rectray explore`.

PAGE_BUILD := build/page
PAGE       := build/rectray.html
CJSON_DIR  ?= build/cjson

# The folders of src/ that the module is made of, without what needs processes, signals or libpng.
PAGE_LEAVES  := %/process.c %/interrupt.c %/output.c %/watch.c %/generate.c %/generate_menger.c %/explore.c \
    %/explore_files.c
PAGE_FOLDERS := base json scene reader trace walkthrough page
PAGE_SOURCES := $(filter-out $(PAGE_LEAVES),$(wildcard $(PAGE_FOLDERS:%=src/%/*.c))) \
    src/picture/map.c src/picture/heat.c
PAGE_OBJECTS := $(patsubst src/%.c,$(PAGE_BUILD)/%.o,$(PAGE_SOURCES)) $(PAGE_BUILD)/cJSON.o

# Without -nostdlibinc clang takes the headers of this machine. The linker gets no -O: clang would then run wasm-opt
# where it is installed, and the bytes would depend on the machine.
WASM         := clang --target=wasm32-wasi -nostdlibinc -isystem /usr/include/wasm32-wasi -O2 -flto
WASM_STANDARD = $(filter-out -fno-tree-slp-vectorize,$(STANDARD))
# The <tgmath.h> of this C library promotes in its macros.
WASM_WARNINGS = $(filter-out -Wdouble-promotion,$(WARNINGS))
WASM_LINK    := clang --target=wasm32-wasi -flto -mexec-model=reactor -Wl,-z,stack-size=1048576 -Wl,--stack-first \
    -Wl,--strip-all

PAGE_PARTS := $(wildcard src/page/*.html src/page/*.css src/page/*.js)
PAGE_SCENES := $(wildcard scenes/*.json scenes/lessons/*.json scenes/models/*.*)

.PHONY: page
page: ## build build/rectray.html: click a pixel and read how it came about
	@$(SETUP) page
	@$(MAKE) --no-print-directory $(if $(V),,--silent) $(PAGE)
	@echo "The page is $(abspath $(PAGE)); a program built from now on can do: rectray explore SCENE"

$(PAGE): $(PAGE_BUILD)/template.html src/page/build.sh src/page/page.mk $(PAGE_SCENES)
	$(call say,page,$@)
	$(Q)sh src/page/build.sh fill $(PAGE_BUILD)/template.html $(PAGE_SCENES) >$@

# All of the page but the scenes. The program carries it for `explore`.
$(PAGE_BUILD)/template.html: $(PAGE_BUILD)/rectray.wasm src/page/build.sh docs/algorithm.md $(PAGE_PARTS)
	$(call say,template,$@)
	$(Q)sh src/page/build.sh template $(PAGE_BUILD)/rectray.wasm docs/algorithm.md >$@

$(PAGE_BUILD)/rectray.wasm: $(PAGE_OBJECTS)
	$(call say,link,$@)
	$(Q)$(WASM_LINK) $^ -o $@

$(PAGE_BUILD)/%.o: src/%.c $(CJSON_DIR)/cjson/cJSON.c
	@mkdir -p $(@D)
	$(call say,compile,$<)
	$(Q)$(WASM) $(WASM_STANDARD) $(WASM_WARNINGS) $(WERROR) -MMD -MP -Isrc -I. -isystem $(CJSON_DIR) -c $< -o $@

$(PAGE_BUILD)/cJSON.o: $(CJSON_DIR)/cjson/cJSON.c
	@mkdir -p $(@D)
	$(call say,compile,$<)
	$(Q)$(WASM) -c $< -o $@

build/cjson/cjson/cJSON.c:
	@.ci/unity --cjson build/cjson

# `make test` builds the page where that can be done and a browser is there.
PAGE_TO_TEST = $(if $(filter %/page_test.py,$(SCRIPT_TESTS)),$(shell \
    $(SETUP) --check page browser 2>/dev/null && echo $(PAGE)))

# The template inside the program, or nothing where it was not built before.
PAGE_TEMPLATE := $(wildcard $(PAGE_BUILD)/template.html)

$(BUILD)/page_template.c: src/page/build.sh $(PAGE_TEMPLATE)
	@mkdir -p $(@D)
	$(call say,embed,$(PAGE_BUILD))
	$(Q)sh src/page/build.sh embed $(PAGE_TEMPLATE) >$@

$(BUILD)/page_template.o: $(BUILD)/page_template.c | $(FOUND)
	$(call say,compile,$<)
	$(Q)$(COMPILE) -c $< -o $@

.PHONY: test-page
test-page: ## test the page in a real browser, which it sets up (Chromium)
	@$(SETUP) build run test page browser
	@$(MAKE) --no-print-directory test suite=page

-include $(PAGE_OBJECTS:.o=.d)
