"""Plots the mean angle of shaken rods while they run: in a window or notebook, or angle.png where there is neither.

python plot_angle.py [TAPS [SCENE]]
"""

import io
import sys

import matplotlib.pyplot as plt
import orzo

BED = """
model: rods
time: {step: 2e-5, taps: 30}
contact: {contact_time: 6e-4, restitution: 0.5}
grains:
  - {kind: random, count: 29, diameter: 1e-3, aspect: 2}
  - {kind: random, count: 1, diameter: 1e-3, aspect: 1}
walls:
  - {kind: plane, motion: {frequency: 50, acceleration_ratio: 2}}
  - {kind: cylinder, diameter: 8e-3}
settle: {drag: 70, time_max: 0.02, rest_time: 0.01}
"""


def shower(figure):
    """A function that shows the figure as it is now: in its place in a notebook, else in its window, if there is one."""
    try:
        from IPython import display, get_ipython
    except ImportError:
        return lambda: plt.pause(0.001)
    if not hasattr(get_ipython(), "kernel"):
        return lambda: plt.pause(0.001)

    def picture():
        file = io.BytesIO()
        figure.savefig(file)
        return display.Image(file.getvalue())

    place = display.display(picture(), display_id=True)
    return lambda: place.update(picture())


def main(taps=None, path=None):
    settings = {"time.taps": int(taps)} if taps else {}
    with orzo.Scene(path, text=None if path else BED, settings=settings) as scene:
        figure, axes = plt.subplots()
        (line,) = axes.plot([], [])
        axes.set(xlabel="tap", ylabel="mean angle of shafts to the floor (degrees)", ylim=(0, 90))
        taps_so_far, angles, show = [], [], shower(figure)
        for time in scene.times(every=scene.period):
            taps_so_far.append(time / scene.period)
            angles.append(scene.observe("angle"))
            line.set_data(taps_so_far, angles)
            axes.set_xlim(0, max(1, taps_so_far[-1]))
            show()
        figure.savefig("angle.png")
        plt.close(figure)
        print(f"{len(angles) - 1} taps, from {angles[0]:.1f} to {angles[-1]:.1f} degrees: angle.png")


if __name__ == "__main__":
    main(*sys.argv[1:])
