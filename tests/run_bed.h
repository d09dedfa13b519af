/* The bed of rods that tests run with the program itself: small, shaken, with pictures or without.
 */
#ifndef OZ_TESTS_RUN_BED_H
#define OZ_TESTS_RUN_BED_H

/* Taps of 1000 steps. One grain is unlike the others: the kernels are those of other tests' beds.
 */
static const char bed[] = "model: rods\n"
                          "time: {step: 2e-5, taps: 2}\n"
                          "contact: {contact_time: 6e-4, restitution: 0.5}\n"
                          "grains:\n"
                          "  - {kind: random, count: 29, diameter: 1e-3, aspect: 2}\n"
                          "  - {kind: random, count: 1, diameter: 1e-3, aspect: 1}\n"
                          "walls:\n"
                          "  - {kind: plane, motion: {frequency: 50, acceleration_ratio: 2}}\n"
                          "  - {kind: cylinder, diameter: 8e-3}\n"
                          "settle: {drag: 70, time_max: 0.02, rest_time: 0.01}\n"
                          "observe: {interval_taps: 0.5}\n";
static const char pictures[] = "movie: {size: [320, 240], fps: 10, length: 0.5}\n"
                               "snapshots: {taps: [0, 1, 50]}\n";

#endif
