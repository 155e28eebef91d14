/* The walkthrough as an answer and its steps, for the web page: one JSON object. First what a reader wants to know at
 * once: the path, what each hit adds, which lights reach it, why the path ended. Then the text, cut into its steps. */
#include "walkthrough/walkthrough_formats.h"

#include "walkthrough/walkthrough_words.h"
#include "json/json_node.h"

#include <stdlib.h>
#include <string.h>

/* --- The text, step by step --- */

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

static void put_steps(JsonNode node, const Walkthrough *walk, WalkthroughStyle style, Error *error)
{
    Steps steps = {0};
    WalkthroughStepListener listener = {begin_step, &steps};
    style.listener = &listener;
    style.parts = WALKTHROUGH_STEPS;
    steps.out = open_memstream(&steps.text, &steps.length);
    bool written = steps.out && walkthrough_write_text(steps.out, walk, style, error);
    written = steps.out && fclose(steps.out) == 0 && written;
    *node.failed = *node.failed || !written || steps.failed;
    if (!*node.failed) {
        put_text(node, "head", steps.text, steps.count > 0 ? steps.marks[0].begin : steps.length);
        JsonNode list = json_node_array(node, "steps");
        for (int k = 0; k < steps.count; k++)
            put_step(list, &steps, k);
    }
    for (int k = 0; k < steps.count; k++)
        free(steps.marks[k].title);
    free(steps.marks);
    free(steps.text);
}

/* --- The answer --- */

/* "star/32"; a face that is all of its object needs no number. */
static InkText name_of(const Scene *scene, int face)
{
    const Object *object = &scene->objects[scene->faces[face].object];
    return object->face_count == 1 ? ink_name(object->name, 40) : walkthrough_face_words(scene, face, 40);
}

typedef struct Answer {
    const Walkthrough *walk;
    JsonNode node, hits, hit, lights;
    WalkthroughPlace place;
} Answer;

static void put_hit(Answer *answer, const Event *event)
{
    const Scene *scene = answer->walk->scene;
    int face = event->as.hit.face;
    answer->hit = json_node_append_object(answer->hits);
    json_node_text(answer->hit, "name", ink_text("P%d", event->as.hit.step + 1).text);
    json_node_text(answer->hit, "face", name_of(scene, face).text);
    json_node_text(answer->hit, "material", scene->materials[scene->faces[face].material].name);
    json_node_number(answer->hit, "index", face);
    answer->lights = json_node_array(answer->hit, "lights");
}

static void put_light(const Answer *answer, const Event *event)
{
    JsonNode light = json_node_append_object(answer->lights);
    json_node_number(light, "light", event->as.light_end.light);
    json_node_text(light, "verdict", walkthrough_light_verdicts[event->as.light_end.verdict]);
    json_node_text(light, "words", walkthrough_light_words(answer->walk, &answer->place, event).text);
    if (event->as.light_end.verdict == LIGHT_BLOCKED)
        json_node_text(light, "blocker", name_of(answer->walk->scene, event->as.light_end.blocker).text);
}

static void put_contribution(JsonNode node, double weight, Vec3 contribution)
{
    json_node_text(node, "weight", ink_number(weight, INK_DIGITS).text);
    json_node_vector(node, "contribution", contribution);
    json_node_text(node, "words", ink_vector(contribution, INK_DIGITS).text);
}

static void put_pixel(const Answer *answer, const Event *event)
{
    const unsigned char *rgb = event->as.pixel.rgb;
    json_node_text(answer->node, "pixel", walkthrough_pixel_words(answer->walk, event).text);
    json_node_vector(answer->node, "rgb", vec3(rgb[0], rgb[1], rgb[2]));
    json_node_number(answer->node, "samples", event->as.pixel.samples);
}

static void put_event(Answer *answer, const Event *event)
{
    switch (event->kind) {
    case EVENT_HIT:
        put_hit(answer, event);
        break;
    case EVENT_LIGHT_END:
        put_light(answer, event);
        break;
    case EVENT_SHADED:
        put_contribution(answer->hit, event->as.shaded.weight, event->as.shaded.contribution);
        break;
    case EVENT_MISS:
        put_contribution(json_node_object(answer->node, "background"), event->as.miss.weight,
                         event->as.miss.weight_times_background);
        break;
    case EVENT_PATH_END:
        json_node_text(answer->node, "end", walkthrough_end_words(answer->walk, &answer->place, event).text);
        json_node_vector(answer->node, "sum", event->as.path_end.colour);
        break;
    default:
        break;
    }
}

static void put_answer(JsonNode node, const Walkthrough *walk)
{
    Answer answer = {.walk = walk, .node = node, .hits = json_node_array(node, "hits")};
    for (long i = 0; i < walk->count && !*node.failed; i++) {
        const Event *event = &walk->events[i];
        walkthrough_follow(&answer.place, walk, event);
        if (event->kind == EVENT_PIXEL)
            put_pixel(&answer, event);
        else if (answer.place.told)
            put_event(&answer, event);
    }
}

bool walkthrough_write_steps(FILE *out, const Walkthrough *walk, WalkthroughStyle style, Error *error)
{
    bool failed = false;
    JsonNode node = json_node_new(&failed);
    put_answer(node, walk);
    put_steps(node, walk, style, error);
    char *text = failed ? NULL : cJSON_PrintUnformatted(node.object);
    if (text)
        fputs(text, out);
    cJSON_free(text);
    cJSON_Delete(node.object);
    return text || error_memory(error, "the walkthrough");
}
