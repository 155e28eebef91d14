/* A table from names to numbers. */
#include "base/names.h"

#include <assert.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* FNV-1a: http://www.isthe.com/chongo/tech/comp/fnv/ */
static uint32_t hash_of(const char *text)
{
    uint32_t hash = 2166136261u;
    for (; *text; text++)
        hash = (hash ^ (unsigned char)*text) * 16777619u;
    return hash;
}

/* The name's slot, or the free one where it would go. The capacity is a power of two, and never full. */
static int slot_of(const Names *names, const char *text)
{
    uint32_t mask = (uint32_t)names->capacity - 1, i = hash_of(text) & mask;
    while (names->slots[i].text && strcmp(names->slots[i].text, text) != 0)
        i = (i + 1) & mask;
    return (int)i;
}

int names_find(const Names *names, const char *text)
{
    if (names->count == 0)
        return -1;
    Name slot = names->slots[slot_of(names, text)];
    return slot.text ? slot.value : -1;
}

static bool grow(Names *names, Error *error)
{
    Names larger = {.capacity = names->capacity ? 2 * names->capacity : 16, .count = names->count};
    larger.slots = calloc((size_t)larger.capacity, sizeof *larger.slots);
    if (!larger.slots)
        return error_memory(error, "a table of names");
    for (int i = 0; i < names->capacity; i++)
        if (names->slots[i].text)
            larger.slots[slot_of(&larger, names->slots[i].text)] = names->slots[i];
    free(names->slots);
    *names = larger;
    return true;
}

bool names_add(Names *names, const char *text, int value, Error *error)
{
    assert(value >= 0);
    if (2 * (names->count + 1) > names->capacity && !grow(names, error))
        return false;
    names->slots[slot_of(names, text)] = (Name){text, value};
    names->count++;
    return true;
}

void names_free(Names *names)
{
    free(names->slots);
    *names = (Names){0};
}
