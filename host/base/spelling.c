/* Distances between words. */
#include "base/spelling.h"

#include <string.h>

static int least(int a, int b, int c)
{
    int ab = a < b ? a : b;
    return ab < c ? ab : c;
}

int oz_spelling_distance(const char *a, const char *b)
{
    int n = (int)strlen(a), m = (int)strlen(b);
    int cost[OZ_SPELLING_LONGEST + 1][OZ_SPELLING_LONGEST + 1];
    for (int i = 0; i <= n; i++) {
        cost[i][0] = i;
    }
    for (int j = 0; j <= m; j++) {
        cost[0][j] = j;
    }
    for (int i = 1; i <= n; i++) {
        for (int j = 1; j <= m; j++) {
            int replaced = cost[i - 1][j - 1] + (a[i - 1] != b[j - 1]);
            cost[i][j] = least(cost[i - 1][j] + 1, cost[i][j - 1] + 1, replaced);
            bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped && cost[i - 2][j - 2] + 1 < cost[i][j]) {
                cost[i][j] = cost[i - 2][j - 2] + 1;
            }
        }
    }
    return cost[n][m];
}

int oz_spelling_slips(size_t letters)
{
    return (int)letters / 3;
}

bool oz_spelling_nears(const char *word, const char *name, int *best)
{
    bool fits = strlen(word) <= OZ_SPELLING_LONGEST && strlen(name) <= OZ_SPELLING_LONGEST;
    int away = fits ? oz_spelling_distance(word, name) : *best;
    bool nears = away < *best;
    *best = nears ? away : *best;
    return nears;
}
