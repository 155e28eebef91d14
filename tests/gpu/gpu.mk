# What compilers and devices say of the kernel for GPUs. docs/gpu.md tells of it.

.PHONY: gpu-report
gpu-report: ## compile the kernels for GPUs and tell registers, memory, doubles (COUNTS=1: count instructions, too)
	@$(SETUP) build run gpu
	@.ci/gpu_tools
	@$(MAKE) --no-print-directory --silent $(PROGRAM) $(SHIM)
	@python3 tests/gpu/report.py $(PROGRAM) $(SHIM) $(if $(COUNTS),--counts)
