/* The distance between two words is the optimal string alignment distance: Levenshtein's with swaps of
 * neighbours (Damerau 1964), for a swap is what fingers do most. */
#include "base/suggest.h"

#include <stddef.h>
#include <string.h>

enum { LONGEST = 48 }; /* no known word is longer; a longer mistake is near to none of them */

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

/* Both words are at most LONGEST long. d[i][j] is the distance of the first i letters of a to the first j of b. */
static int word_distance(const char *a, const char *b)
{
    int d[LONGEST + 1][LONGEST + 1];
    int m = (int)strlen(a), n = (int)strlen(b);
    for (int i = 0; i <= m; i++)
        d[i][0] = i;
    for (int j = 0; j <= n; j++)
        d[0][j] = j;
    for (int i = 1; i <= m; i++) {
        for (int j = 1; j <= n; j++) {
            int replaced = d[i - 1][j - 1] + (a[i - 1] != b[j - 1]);
            d[i][j] = smaller(replaced, smaller(d[i - 1][j], d[i][j - 1]) + 1);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = smaller(d[i][j], d[i - 2][j - 2] + 1);
        }
    }
    return d[m][n];
}

const char *suggest_word(const char *word, const char *const *known)
{
    if (strlen(word) > LONGEST)
        return NULL;
    const char *nearest = NULL;
    int nearest_distance = 0;
    for (; *known; known++) {
        if (strlen(*known) > LONGEST)
            continue;
        int distance = word_distance(word, *known);
        int allowed = ((int)strlen(*known) + 2) / 3;
        if (distance <= allowed && distance < (int)strlen(word) && (!nearest || distance < nearest_distance)) {
            nearest = *known;
            nearest_distance = distance;
        }
    }
    return nearest;
}
