/* Scenes of test_state that it has no room for: integrator, precision, broadphase, ledger. */
#ifndef OZ_TESTS_STATE_SCENES_H
#define OZ_TESTS_STATE_SCENES_H

/* The crowd of test_shear, whose kernels these are; its lattice turns five times. */
static const char sheared[] =
    "model: rods\n"
    "integrator: %s\n"
    "precision: %s\n"
    "broadphase: %s\n"
    "gravity: [0, 0, 0]\n"
    "time: {step: 1e-5, duration: 6e-3}\n"
    "contact: {contact_time: 3e-4, restitution: 0.8, friction: 0.4, rolling_friction: 0.1}\n"
    "boundary: {x: periodic, y: periodic, z: periodic, size: [5e-3, 4e-3, 3.3e-3], "
    "shear_rate: 1000}\n"
    "grains:\n"
    "  - {kind: random, count: 40, diameter: 0.00048828125, aspect: 1, fill: 0.25, "
    "velocity_spread: 0.1}\n"
    "  - {kind: random, count: 60, diameter: 0.00048828125, fill: 0.25}\n"
    "movie: {fps: 10, length: 2}\n"
    "observe: {ledger: %s, interval: 5e-4}\n";

/* The drum of test_element_device, with a floor that is taken away on the way. */
static const char drum[] =
    "model: trigrains\n"
    "gravity: [3, -20]\n"
    "time: {step: 1e-6, duration: 1.2e-3}\n"
    "contact: {law: hertz, hertz_stiffness: 1e5, normal_damping_rate: 500, "
    "tangential_damping_rate: 100, friction: 0.3}\n"
    "grains:\n"
    "  - {kind: single, shape: square, edge: 2e-3, position: [0, 1.3e-3], angle: 10}\n"
    "  - {kind: single, shape: disc, radius: 1e-3, density: 4, position: [-3e-3, 1.005e-3]}\n"
    "walls:\n"
    "  - {kind: segment, from: [-9e-3, 0], to: [9e-3, 0], until: 8e-4}\n"
    "  - {kind: drum, point: [0, 0], diameter: 1.2e-2, teeth: 20, tooth_depth: 5e-4, "
    "motion: {angular_velocity: 200}}\n"
    "observe: {ledger: true, interval: 5e-5}\n";

#endif
