# The exercises of docs/exercises: what their tests share is compiled here, the student's file by tests/exercises/run.

EXERCISES        := $(BUILD)/exercises
EXERCISE_SHARED  := $(patsubst tests/%.c,$(BUILD)/tests/%.o,$(wildcard tests/exercises/*.c))
EXERCISE_PARTS   := $(EXERCISE_SHARED) $(LIBRARY) $(EXERCISES)/commands

# A student's function may be a loop without an end, or write where nothing is. Without -O it compiles in a third of
# the time, and a line of code is a line of the message.
EXERCISE_WATCHED := -O0 -g -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=all \
    $(INSTRUMENT)
EXERCISE_WARNINGS := -Wall -Wextra -Wno-unused-parameter -Wno-unused-function -Wno-missing-field-initializers \
    -Werror=implicit-function-declaration

# How `run` compiles a test with the student's file in it, and how it links it: a line each.
$(EXERCISES)/commands: Makefile tests/exercises/exercises.mk | $(FOUND)
	@mkdir -p $(@D)
	@echo '$(CC) $(STANDARD) $(EXERCISE_WARNINGS) $(EXERCISE_WATCHED)' >$@
	@echo '$(CC) $(EXERCISE_WATCHED) $(LDFLAGS) $(abspath $(EXERCISE_SHARED) $(LIBRARY)) $(LIBS)' >>$@

SCRIPT_TEST_PROGRAMS += $(if $(filter %/exercises_test.py,$(SCRIPT_TESTS)),$(EXERCISE_PARTS))

.PHONY: exercise-parts
exercise-parts: $(EXERCISE_PARTS) $(PROGRAM)

.PHONY: exercise
exercise: ## check your FILE for exercise N of docs/exercises (without FILE: its stub; JSON=1: for scripts)
	@test -n "$(N)" || { echo "Which one? Say, for instance, make exercise N=3" >&2; exit 2; }
	@$(SETUP) build test >&2
	@$(MAKE) $(ALL_CORES) exercise-parts >&2
	@BUILD=$(BUILD) tests/exercises/run $(N) $(if $(FILE),"$(FILE)") $(if $(JSON),--json)

# The pictures of the goals: folder, scene, size.
GOALS := 01-camera/leaning/200x160 02-plane/scene/216x168 03-inside/scene/200x150 04-nearest/scene/200x150 \
    05-shadow/scene/200x150 06-light/scene/180x140 07-mirror/scene/216x168

.PHONY: exercise-goals
exercise-goals: $(PROGRAM) ## render the pictures that the exercises show as their goals
	@for goal in $(GOALS); do \
	    folder=docs/exercises/$${goal%%/*}; rest=$${goal#*/}; \
	    $(PROGRAM) render $$folder/$${rest%/*}.json --size $${rest#*/} --backend reference -q -o $$folder/goal.png || \
	        exit 1; \
	done

-include $(EXERCISE_SHARED:.o=.d)
