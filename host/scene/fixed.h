/* Why the value of a row (scene/rows.c) cannot change while a scene runs, for its .fixed. */
#pragma once

#define FIXED(reason) .fixed = reason
#define GRAINS_MADE   FIXED("grains are made before the first step")
#define WALLS_MADE                                                                                 \
    FIXED("walls are made before the first step, and one that jumped would throw grains")
#define COMES     FIXED("walls come and go at the times of the start")
#define SETTLED   FIXED("grains settle by what it is at the start")
#define TAP_MEANS FIXED("tap means have begun with it")
#define COLUMNS   FIXED("the run's files have been begun with it")
#define ONE_FILE  FIXED("the movie has been begun with it")
