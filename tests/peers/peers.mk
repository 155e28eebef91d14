# The programs that ours is measured against, or that help to: Embree and POV-Ray. Each links our library, so that it
# reads the same scenes. The Makefile includes this file.

# Built for this machine alone, as fast as the compiler can.
PEERS := $(BUILD)/peers/embree $(BUILD)/peers/povray_export
PEER_CFLAGS := -std=gnu99 -O3 -march=native -mprefer-vector-width=512 -ffast-math $(WARNINGS)

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

.PHONY: bench-peers
bench-peers: peers ## measure the ladder beside Embree and POV-Ray: renews docs/performance.md and its plots
	@$(SETUP) build run bench peers
	$(PROGRAM) bench --ladder --folder build/bench -o docs/performance.md
	@$(call plots,docs/images)

# What the next two measure with besides: make bench-kernels BENCH_FLAGS="--size 64x48 --repeats 1" tries it out.
BENCH_FLAGS :=

.PHONY: bench-error
bench-error: ## time against error, of the ladder's small scenes: renews docs/accuracy.md and its plots (minutes)
	@$(SETUP) build run bench
	@$(MAKE) --no-print-directory --silent $(PROGRAM)
	$(PROGRAM) bench error --ladder --folder build/bench --repeats 3 -o docs/accuracy.md $(BENCH_FLAGS)
	@for scene in original cornell mirrors gallery menger-2 city-1k; do \
	    gnuplot -e "folder='build/bench'; out='docs/images'; scene='$$scene'" docs/plots/error.gp; \
	done
	@gnuplot -e "folder='build/bench'; out='docs/images'" docs/plots/arithmetic.gp

.PHONY: bench-kernels
bench-kernels: ## one kernel after another on two scenes: renews docs/kernel.md and its plots (minutes)
	@$(SETUP) build run bench
	@$(MAKE) --no-print-directory --silent $(PROGRAM)
	@mkdir -p build/bench
	$(PROGRAM) generate city --size 1000 -o build/bench/city-1k.json
	$(PROGRAM) bench kernels scenes/gallery.json build/bench/city-1k.json --folder build/bench -o docs/kernel.md \
	    $(BENCH_FLAGS)
	@for scene in gallery city-1k; do \
	    gnuplot -e "folder='build/bench'; out='docs/images'; scene='$$scene'" docs/plots/kernels.gp; \
	done
