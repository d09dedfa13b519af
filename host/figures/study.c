/* Finding by name. */
#include "figures/study.h"

#include <string.h>

int oz_study_find_run(const OzStudy *study, const char *name)
{
    for (int i = 0; i < study->run_count; i++) {
        if (study->runs[i].name && strcmp(study->runs[i].name, name) == 0) {
            return i;
        }
    }
    return -1;
}

int oz_study_find_figure(const OzStudy *study, const char *name)
{
    for (int i = 0; i < study->figure_count; i++) {
        if (study->figures[i].name && strcmp(study->figures[i].name, name) == 0) {
            return i;
        }
    }
    return -1;
}
