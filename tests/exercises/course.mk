# For lecturers and students, beside the exercises: bug hunts, our own functions, the figures of the slides.
# docs/course.md tells how a course uses them.

.PHONY: hunt
hunt: ## plant a fault in a copy of the tracer, to be found: pictures and walkthroughs in build/hunt/ (SEED=1, 2, ...)
	@$(SETUP) build test
	@$(MAKE) $(ALL_CORES) $(PROGRAM)
	@tests/exercises/hunt.py plant $(SEED)

.PHONY: hunt-answer
hunt-answer: ## tell the fault of `make hunt SEED=n`: file, line, and why it shows
	@tests/exercises/hunt.py answer $(SEED)

.PHONY: solution
solution: ## print our own function for exercise N of docs/exercises, with its comments
	@tests/exercises/solution.py $(N)

.PHONY: figures
figures: ## write the figures of the course's slides, with a page that shows them, to build/figures/
	@$(SETUP) build test figures
	@$(MAKE) $(ALL_CORES) $(PROGRAM)
	@tests/exercises/figures.py
