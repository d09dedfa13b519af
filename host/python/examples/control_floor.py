"""A controller of the floor: shakes a bed so that its centre of mass dances at a height that is asked for.

Each tap it reads how high the grains' centre of mass stood on average and changes the floor's acceleration by the share that
is missing. python control_floor.py [TAPS]
"""

import sys

import numpy as np
import orzo

BED = """
model: rods
time: {step: 2e-5, duration: endless}
contact: {contact_time: 6e-4, restitution: 0.5}
grains:
  - {kind: random, count: 29, diameter: 1e-3, aspect: 2}
  - {kind: random, count: 1, diameter: 1e-3, aspect: 1}
walls:
  - {kind: plane, motion: {frequency: 50, acceleration_ratio: 2}}
  - {kind: cylinder, diameter: 8e-3}
settle: {drag: 70, time_max: 0.02, rest_time: 0.01}
"""


def mean_height(scene, looks=20):
    """m, of the centre of mass over the next tap."""
    mass, heights = scene.mass, []
    for _ in scene.times(every=scene.period / looks, until=scene.time + scene.period):
        heights.append(np.average(scene.position[:, 2], weights=mass))
    return float(np.mean(heights))


def main(taps=60):
    with orzo.Scene(text=BED) as scene:
        scene.start()
        rest = float(np.average(scene.position[:, 2], weights=scene.mass))
        wanted, ratio = rest + 1.5e-3, 2.0
        heights = []
        for _ in range(int(taps)):
            heights.append(mean_height(scene))
            ratio = float(np.clip(ratio * (1 + 0.1 * (wanted - heights[-1]) / (wanted - rest)), 1.2, 12))
            scene["walls.0.motion.acceleration_ratio"] = ratio
        late = np.mean(heights[len(heights) // 2 :])
        print(f"asked for {1e3 * wanted:.2f} mm, {1e3 * late:.2f} mm over the later half, at {ratio:.2f} g; at rest {1e3 * rest:.2f} mm")
        return late, wanted, rest


if __name__ == "__main__":
    main(*sys.argv[1:])
