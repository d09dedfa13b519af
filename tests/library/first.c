/* What a user's first program may be: final.csv's first columns of a scene. */
#include <orzo.h>
#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv)
{
    OrzoSim *sim = NULL;
    if (argc != 2 || orzo_open(&sim, argv[1]) != ORZO_OK || orzo_run_to(sim, orzo_end(sim))) {
        fprintf(stderr, "%s\n", orzo_error());
        return 1;
    }
    int64_t count = orzo_count(sim);
    double *place = malloc((size_t)count * 3 * sizeof *place);
    if (!place || orzo_read(sim, ORZO_POSITION, place, 3 * count) != ORZO_OK) {
        return 1;
    }
    for (int64_t i = 0; i < count; i++) {
        printf("%.17g,%.17g,%.17g\n", place[3 * i], place[3 * i + 1], place[3 * i + 2]);
    }
    free(place);
    orzo_close(sim);
    return 0;
}
