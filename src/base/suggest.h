/* "Did you mean": the known word that a mistyped one is nearest to. */
#ifndef RECTRAY_SUGGEST_H
#define RECTRAY_SUGGEST_H

/* The word of `known` (which ends in a NULL) with the fewest insertions, deletions, replacements and swaps of
 * neighbouring letters away from `word`; the earlier one of equals. NULL where none is within a third of its own length
 * (rounded up), so that a word from another world gets no silly suggestion. */
const char *suggest_word(const char *word, const char *const *known);

#endif
