"""Friction from a measured angle of repose: a bisection over heaps of spheres, each with several seeds.

A column of spheres between two smooth panes falls when its gate opens; the slope of what is left is compared with the measured
angle. python calibrate_friction.py ANGLE [STEPS] [SEEDS]      (degrees)
"""

import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import orzo

GAP, WIDTH = 5e-3, 57e-3  # m, between the panes; of the column

HEAP = f"""
model: rods
time: {{step: 4e-5, duration: 0.8}}
contact: {{contact_time: 1.2e-3, restitution: 0.3, friction: 0.3}}
grains:
  - {{kind: lattice, diameter: [3e-3, 4e-3], aspect: 0, cells: [9, 1, 7], spacing: [6e-3, 6e-3, 6e-3],
     position: [2.2e-3, 0, 2.1e-3]}}
  - {{kind: lattice, diameter: [3e-3, 4e-3], aspect: 0, cells: [9, 1, 7], spacing: [6e-3, 6e-3, 6e-3],
     position: [5.2e-3, 0, 5.1e-3]}}
walls:
  - {{kind: plane, contact: {{friction: 1}}}}
  - {{kind: plane, normal: [1, 0, 0], contact: {{friction: 0}}}}
  - {{kind: plane, normal: [0, 1, 0], point: [0, {-GAP / 2}, 0], contact: {{friction: 0}}}}
  - {{kind: plane, normal: [0, -1, 0], point: [0, {GAP / 2}, 0], contact: {{friction: 0}}}}
  - {{kind: plane, normal: [-1, 0, 0], point: [{WIDTH}, 0, 0], contact: {{friction: 0}}, until: 0.01}}
settle: {{drag: 70, time_max: 0.2, rest_time: 0.02}}
"""


def heap(friction, seed):
    """What is left of the column: the slope of a line through its slices' highest grains (degrees), and how far it reaches (mm)."""
    with orzo.Scene(text=HEAP, settings={"contact.friction": friction, "seed": seed}) as scene:
        scene.run_to(scene.end)
        x, z = scene.position[:, 0], scene.position[:, 2] + scene.diameter / 2
    reach = np.quantile(x, 0.97)
    edges = np.arange(0, reach, 6e-3)
    tops = [z[(x >= a) & (x < a + 6e-3)].max() for a in edges if ((x >= a) & (x < a + 6e-3)).any()]
    slope = np.polyfit(np.arange(len(tops)) * 6e-3, tops, 1)[0]
    return float(np.degrees(np.arctan(-slope))), 1e3 * float(reach)


def heaps(friction, seeds):
    """The same of each of so many seeds, two at a time."""
    with ThreadPoolExecutor(2) as pool:
        return np.array(list(pool.map(lambda seed: heap(friction, seed), range(1, seeds + 1))))


def mean_angle(friction, seeds):
    angles = heaps(friction, seeds)[:, 0]
    return float(np.mean(angles)), float(np.std(angles) / np.sqrt(len(angles)))


def main(measured=8.0, steps=6, seeds=4):
    low, high = 0.02, 1.0
    for _ in range(int(steps)):
        friction = (low + high) / 2
        angle, error = mean_angle(friction, int(seeds))
        print(f"friction {friction:.3f}: {angle:.1f} +- {error:.1f} degrees")
        low, high = (friction, high) if angle < float(measured) else (low, friction)
    print(f"friction {(low + high) / 2:.3f} +- {(high - low) / 2:.3f} for {float(measured):g} degrees")
    return (low + high) / 2


if __name__ == "__main__":
    main(*sys.argv[1:])
