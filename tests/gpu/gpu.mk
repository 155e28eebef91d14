# What compilers and devices say of the kernel for GPUs. docs/gpu.md tells of it.

.PHONY: gpu-report
gpu-report: ## compile the kernels for GPUs and tell registers, memory, doubles (COUNTS=1: count instructions, too)
	@$(SETUP) build run gpu
	@.ci/gpu_tools
	@$(MAKE) --no-print-directory --silent $(PROGRAM) $(SHIM)
	@python3 tests/gpu/report.py $(PROGRAM) $(SHIM) $(if $(COUNTS),--counts)

# What can be built with what is there; nothing is fetched. POSE=1 tries it without a GPU. What building takes is taken
# from the 8 minutes.
gpu-check: private BEGUN = $(shell date +%s)
.PHONY: gpu-check
gpu-check: ## on a machine with a GPU: is it right, and how fast? (at most 8 minutes; POSE=1: without one)
	@$(MAKE) $(ALL_CORES) $(PROGRAM) $(if $(POSE),$(SHIM))
	@timeout 120 $(MAKE) $(ALL_CORES) -k $(BUILD)/tests/test_gpu $(BUILD)/tests/test_backends $(STRESS) || \
	    echo "gpu-check: not every suite can be built here"
	@python3 tests/gpu/check.py --seconds $$((480 + $(BEGUN) - $$(date +%s))) $(if $(POSE),--pose $(SHIM)) $(PROGRAM)
