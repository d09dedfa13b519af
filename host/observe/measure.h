/* What positions and axes alone say about a bed: its density and its directions. Needs no contacts,
 * so it can be taken many times a period. */
#pragma once

#include "model/snapshot.h"

enum { OZ_MEASURE_LAYERS = 4 };

/* What never changes during a run, and room to work in. A zeroed one may be freed. */
typedef struct OzMeasure {
    int floor;      /* of the walls, as observe/basin.h finds it; -1 without one  */
    double area;    /* m^2, cross-section of the container; 0 without one         */
    double *volume; /* m^3, of each grain                                         */
    double total;   /* m^3, sum of volume                                         */
    double mass;    /* kg, of all grains                                          */
    int64_t *heap;  /* room for ordering the grains                               */
    double *top;    /* m, highest point of each grain                             */
} OzMeasure;

/* One layer of the bed; the mean angle is angle_sum / rod_count. */
typedef struct OzLayer {
    int64_t count;     /* grains whose centre lies in it         */
    int64_t rod_count; /* of them, those with a shaft            */
    double angle_sum;  /* degrees                                */
} OzLayer;

OzStatus oz_measure_create(OzMeasure *measure, const OzScene *scene, const OzGrains *grains);
void oz_measure_free(OzMeasure *measure);

/* Each function below returns true and *value, or false where the scene or the bed has no such
 * value (no container, no floor, no rod, no grain). A NaN in the state gives NaN. */

/* All volume / (area H), and 0.95 of it, which is the density without the 5 %. H: order the grains
 * by their highest point and take them from the top while the volume taken is at most 5 % of all
 * (to 1e-9); H is the highest point of the rest above the moving floor. */
bool oz_measure_density_all(OzMeasure *measure, const OzSnapshot *snapshot, double *value);
bool oz_measure_density(OzMeasure *measure, const OzSnapshot *snapshot, double *value);

/* The second from the first, which takes time. */
double oz_measure_density_of_all(double all);

/* All volume / (area x twice the height of the centre of mass above the moving floor). */
bool oz_measure_density_com(const OzMeasure *measure, const OzSnapshot *snapshot, double *value);

/* Grain volume between 2 and 10 mm above the moving floor / (area x 8 mm). */
bool oz_measure_density_slab(const OzMeasure *measure, const OzSnapshot *snapshot, double *value);

/* Mean angle between shaft and floor, degrees 0..90, over the rods. */
bool oz_measure_angle(const OzSnapshot *snapshot, double *value);

/* The layers of thickness scene->observe.layer_thickness, by grain centre, from the place of the
 * floor at rest; layer i holds i x thickness <= height < (i + 1) x thickness. All are empty without
 * a floor. */
void oz_measure_layers(const OzMeasure *measure, const OzSnapshot *snapshot,
                       OzLayer layers[OZ_MEASURE_LAYERS]);

/* Largest eigenvalue of Q = <3 u u - 1> / 2 over the rods: 1 aligned, 0 isotropic. */
bool oz_measure_nematic(const OzSnapshot *snapshot, double *value);
