/* What was meant by a word that is not known. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

enum { OZ_SPELLING_LONGEST = 63 }; /* letters that are compared */

/* Letters to insert, delete, replace or swap with the next to make one of the other (Damerau 1964,
 * restricted); of words of at most OZ_SPELLING_LONGEST letters. */
int oz_spelling_distance(const char *a, const char *b);

/* How many wrong letters are still a slip of the hand in a word of so many; more is another word.
 */
int oz_spelling_slips(size_t letters);

/* Whether the word is less than *best away from a name, which *best becomes then; longer words than
 * are compared never are. */
bool oz_spelling_nears(const char *word, const char *name, int *best);
