/* A walkthrough in short, from its events. */
#include "walkthrough/walkthrough_summary.h"

#include "walkthrough/walkthrough_words.h"

#include <stdlib.h>
#include <string.h>

static void add_hit(Summary *summary, const WalkthroughPlace *place, const Event *event)
{
    int lights = summary->walk->scene->light_count;
    summary->hits[summary->hit_count] = (SummaryHit){
        .face = event->as.hit.face,
        .distance = vec3_length(vec3_sub(event->as.hit.point, place->ray.origin)),
        .lights = summary->lights + (size_t)summary->hit_count * (size_t)lights,
    };
    summary->hit_count++;
}

static void add_light(Summary *summary, const Event *event)
{
    int lights = summary->walk->scene->light_count, light = event->as.light_end.light;
    size_t hit = (size_t)summary->hit_count - 1;
    summary->lights[hit * (size_t)lights + (size_t)light] =
        (SummaryLight){light, event->as.light_end.verdict, event->as.light_end.blocker};
}

static void add_event(Summary *summary, const WalkthroughPlace *place, const Event *event)
{
    SummaryHit *hit = summary->hit_count > 0 ? &summary->hits[summary->hit_count - 1] : NULL;
    switch (event->kind) {
    case EVENT_HIT:
        add_hit(summary, place, event);
        break;
    case EVENT_LIGHT_END:
        add_light(summary, event);
        break;
    case EVENT_SHADED:
        hit->weight = event->as.shaded.weight;
        hit->illumination = event->as.shaded.illumination;
        hit->contribution = event->as.shaded.contribution;
        break;
    case EVENT_MISS:
        summary->missed = true;
        summary->background_weight = event->as.miss.weight;
        summary->background = event->as.miss.weight_times_background;
        break;
    case EVENT_PATH_END:
        summary->end = walkthrough_reason_words(summary->walk, place, event);
        summary->colour = event->as.path_end.colour;
        break;
    default:
        break;
    }
}

bool summary_make(Summary *summary, const Walkthrough *walk, Error *error)
{
    size_t hits = (size_t)walk->scene->shading.max_bounces + 1, lights = (size_t)walk->scene->light_count;
    *summary = (Summary){.walk = walk};
    summary->hits = calloc(hits, sizeof *summary->hits);
    summary->lights = calloc(hits * lights + 1, sizeof *summary->lights);
    if (!summary->hits || !summary->lights) {
        summary_free(summary);
        return error_memory(error, "the walkthrough");
    }
    WalkthroughPlace place = {0};
    for (long i = 0; i < walk->count; i++) {
        const Event *event = &walk->events[i];
        walkthrough_follow(&place, walk, event);
        if (place.told)
            add_event(summary, &place, event);
    }
    const Event *pixel = &walk->events[walk->count - 1];
    summary->samples = pixel->as.pixel.samples;
    memcpy(summary->rgb, pixel->as.pixel.rgb, sizeof summary->rgb);
    return true;
}

void summary_free(Summary *summary)
{
    free(summary->hits);
    free(summary->lights);
    *summary = (Summary){0};
}
