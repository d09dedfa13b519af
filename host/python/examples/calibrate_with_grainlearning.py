"""Friction from a measured heap, its angle and its reach, as a distribution: by the Bayesian filter of GrainLearning.

GrainLearning (Cheng et al., a package of its own) draws samples of the friction, weighs them by how well their heaps agree with
the measured one, and draws the next samples where the weight is.
python calibrate_with_grainlearning.py ANGLE REACH [ITERATIONS] [SAMPLES] [SEEDS]      (degrees, mm)
"""

import sys

import numpy as np
from calibrate_friction import heaps
from grainlearning import BayesianCalibration
from grainlearning.dynamic_systems import DynamicSystem


def main(angle=8.3, reach=174.0, iterations=3, samples=10, seeds=4):
    tried = []

    def compute(calibration):
        means = [heaps(friction, int(seeds)).mean(axis=0) for (friction,) in calibration.system.param_data]
        tried.extend(calibration.system.param_data[:, 0])
        calibration.system.set_sim_data(np.array(means)[:, :, None])  # sample, observable, step

    calibration = BayesianCalibration.from_dict(
        {
            "num_iter": int(iterations),
            "callback": compute,
            "system": {
                "system_type": DynamicSystem,
                "param_names": ["friction"],
                "param_min": [0.02],
                "param_max": [1.0],
                "num_samples": int(samples),
                "obs_data": [[float(angle)], [float(reach)]],
                "obs_names": ["angle", "reach"],
                "ctrl_name": "heap",
                "ctrl_data": [0],
                "sigma_tol": 0.01,
            },
            "inference": {"Bayes_filter": {"ess_target": 0.3}, "sampling": {"max_num_components": 1}},
            "save_fig": -1,
        }
    )
    calibration.run()
    mean = float(calibration.system.estimated_params[-1][0])
    spread = mean * float(calibration.system.estimated_params_cv[-1][0])
    print(f"friction {mean:.3f} +- {spread:.3f} after {len(tried)} samples")
    return mean, spread


if __name__ == "__main__":
    main(*map(float, sys.argv[1:]))
