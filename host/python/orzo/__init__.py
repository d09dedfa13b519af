"""Simulations of grains, with NumPy arrays: liborzo in Python.

    import orzo

    with orzo.Scene("bed.yaml", settings={"contact.friction": 0.3}) as scene:
        for time in scene.times(every=0.01):            # s, to the scene's end
            print(time, scene.observe("angle"))         # any column of series.csv
        print(scene.position)                           # m, an array of (grains, 3)

Everything is in SI units. Grains at a time are those of `orzo run`, to the bit. Scenes are independent of each other and may
run in threads of their own: a call lets other threads go on.
"""

from orzo._library import (
    BlowupError,
    DeviceError,
    InputError,
    OrzoError,
    version,
)
from orzo._scene import CONTACT, Scene

__all__ = ["CONTACT", "BlowupError", "DeviceError", "InputError", "OrzoError", "Scene", "version"]
__version__ = version()
