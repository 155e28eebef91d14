/* A text cut into its steps, as JSON. The text's writer tells where each begins. */
#include "walkthrough/walkthrough_cut.h"

#include <stdlib.h>
#include <string.h>

typedef struct StepMark {
    WalkthroughStep step;
    char *title;
    size_t begin; /* in the text */
} StepMark;

typedef struct Steps {
    FILE *out;
    char *text;
    size_t length;
    StepMark *marks;
    int count;
    bool failed;
} Steps;

static void begin_step(void *user, const WalkthroughStep *step)
{
    Steps *steps = user;
    char *title = strdup(step->title);
    StepMark *marks = realloc(steps->marks, ((size_t)steps->count + 1) * sizeof *marks);
    steps->marks = marks ? marks : steps->marks;
    fflush(steps->out);
    steps->failed = steps->failed || !marks || !title;
    if (steps->failed)
        free(title);
    else
        steps->marks[steps->count++] = (StepMark){*step, title, steps->length};
}

static void put_text(JsonNode node, const char *name, const char *text, size_t length)
{
    char *copy = malloc(length + 1);
    *node.failed = *node.failed || !copy;
    if (!copy)
        return;
    memcpy(copy, text, length);
    copy[length] = '\0';
    json_node_text(node, name, copy);
    free(copy);
}

/* "face_test scene/geometry.c" as {"name", "file"}. */
static void put_function(JsonNode list, const char *function)
{
    const char *blank = strchr(function, ' ');
    JsonNode node = json_node_append_object(list);
    put_text(node, "name", function, (size_t)(blank - function));
    json_node_text(node, "file", blank + 1);
}

static void put_step(JsonNode list, const Steps *steps, int k)
{
    const StepMark *mark = &steps->marks[k];
    const WalkthroughStepSource *source = &walkthrough_step_sources[mark->step.kind];
    size_t end = k + 1 < steps->count ? steps->marks[k + 1].begin : steps->length;
    JsonNode node = json_node_append_object(list);
    json_node_text(node, "kind", source->word);
    json_node_number(node, "number", mark->step.number);
    json_node_number(node, "hit", mark->step.hit);
    json_node_number(node, "light", mark->step.light);
    json_node_text(node, "title", mark->title);
    put_text(node, "text", steps->text + mark->begin, end - mark->begin);
    JsonNode functions = json_node_array(node, "functions"), sections = json_node_array(node, "sections");
    for (int i = 0; source->functions[i]; i++)
        put_function(functions, source->functions[i]);
    for (int i = 0; source->sections[i]; i++)
        json_node_append_number(sections, source->sections[i]);
}

static void put_all(JsonNode node, const Steps *steps)
{
    put_text(node, "head", steps->text, steps->count > 0 ? steps->marks[0].begin : steps->length);
    JsonNode list = json_node_array(node, "steps");
    for (int k = 0; k < steps->count; k++)
        put_step(list, steps, k);
}

void walkthrough_cut(JsonNode node, WalkthroughCutWriter *write, const void *what, WalkthroughStyle style, Error *error)
{
    Steps steps = {0};
    WalkthroughStepListener listener = {begin_step, &steps};
    style.listener = &listener;
    steps.out = open_memstream(&steps.text, &steps.length);
    bool written = steps.out && write(steps.out, what, style, error);
    written = steps.out && fclose(steps.out) == 0 && written;
    *node.failed = *node.failed || !written || steps.failed;
    if (!*node.failed)
        put_all(node, &steps);
    for (int k = 0; k < steps.count; k++)
        free(steps.marks[k].title);
    free(steps.marks);
    free(steps.text);
}
