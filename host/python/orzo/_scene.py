"""A scene and its simulation."""

from __future__ import annotations

import math
import os
import time as clock
from collections.abc import Iterator, Mapping
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from orzo._library import FIELDS, check, ffi, lib

Array = NDArray[np.float64]
Path = Union[str, "os.PathLike[str]"]

#: A contact: grains a < b (b = -1 - i at wall i), point (m), normal from a to b, push along it (N, > 0 pushes apart), the
#: rest of the force (N, on b), overlap (m; of triangles m^2).
CONTACT = np.dtype(
    [
        ("a", np.int64),
        ("b", np.int64),
        ("point", np.float64, 3),
        ("normal", np.float64, 3),
        ("push", np.float64),
        ("tangential", np.float64, 3),
        ("overlap", np.float64),
    ]
)
assert CONTACT.itemsize == ffi.sizeof("OrzoContact")

#: s of wall clock between looks for Ctrl-C.
_SLICE = 0.1


def _text_of(value: Any) -> str:
    """A value as a scene file has it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float, np.number)):
        return repr(value.item() if isinstance(value, np.number) else value)
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{key}: {_text_of(item)}" for key, item in value.items()) + "}"
    if isinstance(value, (list, tuple, np.ndarray)):
        return "[" + ", ".join(_text_of(item) for item in value) + "]"
    return str(value)


class Scene:
    """A simulation of the scene in a file (or in `text`), closed at the end of a `with` block or by close().

    settings: keys of the scene and their values, as by `--set`. device: as `--device` takes it; None: chosen. threads: of
    a CPU device; holds for the process. log: a file for what the program would say.

    Grains are placed, kernels built and the bed settled by start(), or by the first call that needs it.
    """

    def __init__(
        self,
        path: Optional[Path] = None,
        *,
        text: Optional[str] = None,
        settings: Optional[Mapping[str, Any]] = None,
        device: Optional[str] = None,
        threads: int = 0,
        log: Optional[Path] = None,
    ) -> None:
        self._sim: Any = ffi.NULL
        if (path is None) == (text is None):
            raise TypeError("expected the path of a scene, or its text")
        self._open(lib.orzo_open, os.fsencode(path) if path is not None else None, text)
        try:
            for key, value in (settings or {}).items():
                self[key] = value
            if device is not None or threads:
                check(lib.orzo_set_device(self._sim, device.encode() if device else ffi.NULL, threads))
            if log is not None:
                check(lib.orzo_set_log(self._sim, os.fsencode(log)))
        except BaseException:
            self.close()
            raise

    def _open(self, call: Any, path: Optional[bytes], text: Optional[str] = None) -> None:
        out = ffi.new("OrzoSim **")
        check(lib.orzo_open_text(out, text.encode()) if text is not None else call(out, path))
        self._sim = out[0]

    @classmethod
    def load(cls, path: Path) -> Scene:
        """A simulation that goes on from a file that save() wrote, to the bit."""
        scene = cls.__new__(cls)
        scene._open(lib.orzo_load, os.fsencode(path))
        return scene

    def save(self, path: Path) -> None:
        """Writes all that later steps depend on into a file."""
        check(lib.orzo_save(self._open_sim(), os.fsencode(path)))

    def close(self) -> None:
        """Ends the simulation; a second time does nothing."""
        sim, self._sim = getattr(self, "_sim", ffi.NULL), ffi.NULL
        lib.orzo_close(sim)

    def __enter__(self) -> Scene:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __del__(self) -> None:
        self.close()

    def _open_sim(self) -> Any:
        if self._sim == ffi.NULL:
            raise ValueError("the scene is closed")
        return self._sim

    def __setitem__(self, key: str, value: Any) -> None:
        """scene["contact.friction"] = 0.3: sets a key before the start, or changes the running simulation as
        `orzo run --watch` does; None takes the key out. What is refused changes nothing."""
        text = ffi.NULL if value is None else _text_of(value).encode()
        check(lib.orzo_set(self._open_sim(), key.encode(), text))

    @property
    def text(self) -> str:
        """The scene as it is now, every key written out, as a scene file."""
        out = ffi.new("char **")
        check(lib.orzo_scene(self._open_sim(), out))
        text = ffi.string(out[0]).decode()
        lib.orzo_free(out[0])
        return text

    # Time

    def start(self) -> None:
        """Places the grains, builds kernels (seconds, the first time on a machine) and lets the bed settle."""
        check(lib.orzo_start(self._open_sim()))

    def run_to(self, time: float) -> None:
        """On to the step nearest to this time, s. Ctrl-C ends it between two steps."""
        self.start()
        steps = 64
        while True:
            ahead = (time - self.time) / self.step_length
            if ahead <= steps:
                check(lib.orzo_run_to(self._sim, time))
                return
            begun = clock.monotonic()
            check(lib.orzo_run_steps(self._sim, steps))
            spent = clock.monotonic() - begun
            steps = max(1, int(steps * min(2.0, _SLICE / max(spent, 1e-9))))

    def run_steps(self, steps: int) -> None:
        """So many steps further."""
        check(lib.orzo_run_steps(self._open_sim(), steps))

    def times(self, every: float, until: Optional[float] = None) -> Iterator[float]:
        """Runs on, and yields the time, s, at each multiple of `every` s from now on up to `until` (default: the scene's
        end)."""
        self.start()
        first, last = self.time, self.end if until is None else until
        yield first
        for k in range(1, int(math.floor((last - first) / every * (1 + 1e-12))) + 1):
            self.run_to(first + k * every)
            yield self.time

    @property
    def time(self) -> float:
        """s since time 0; 0 before the start."""
        return lib.orzo_time(self._open_sim())

    @property
    def step(self) -> int:
        """Steps since time 0."""
        return lib.orzo_step(self._open_sim())

    @property
    def step_length(self) -> float:
        """s of a step."""
        return lib.orzo_step_length(self._open_sim())

    @property
    def end(self) -> float:
        """s: where the scene ends; inf: nowhere."""
        return lib.orzo_end(self._open_sim())

    @property
    def period(self) -> float:
        """s: of the first moving wall; 0 without one."""
        return lib.orzo_period(self._open_sim())

    # Grains, in the order of the scene

    def __len__(self) -> int:
        """Grains."""
        self.start()
        return lib.orzo_count(self._sim)

    def read(self, field: str, out: Optional[Array] = None) -> Array:
        """A field of every grain, written by the library into `out`, or into a new array: position (m), axis, quaternion,
        velocity (m/s), angular_velocity (rad/s), diameter (m), length (m), mass (kg)."""
        if field not in FIELDS:
            raise KeyError(f"{field}: expected one of {', '.join(FIELDS)}")
        width = FIELDS[field][0]
        shape = (len(self), width) if width > 1 else (len(self),)
        values = np.empty(shape) if out is None else out
        if values.dtype != np.float64 or not values.flags.c_contiguous or values.shape != shape:
            raise ValueError(f"expected a contiguous float64 array of shape {shape}")
        pointer = ffi.cast("double *", values.ctypes.data)
        check(lib.orzo_read(self._sim, list(FIELDS).index(field), pointer, values.size))
        return values

    @property
    def position(self) -> Array:
        """m, (grains, 3)."""
        return self.read("position")

    @property
    def axis(self) -> Array:
        """Unit vectors along shafts, (grains, 3)."""
        return self.read("axis")

    @property
    def quaternion(self) -> Array:
        """w x y z, which turn z into axes, (grains, 4)."""
        return self.read("quaternion")

    @property
    def velocity(self) -> Array:
        """m/s, (grains, 3)."""
        return self.read("velocity")

    @property
    def angular_velocity(self) -> Array:
        """rad/s in the frame of the scene, (grains, 3)."""
        return self.read("angular_velocity")

    @property
    def diameter(self) -> Array:
        """m."""
        return self.read("diameter")

    @property
    def length(self) -> Array:
        """m, of shafts; 0 of spheres."""
        return self.read("length")

    @property
    def mass(self) -> Array:
        """kg."""
        return self.read("mass")

    def contacts(self) -> NDArray[np.void]:
        """Every contact now: an array of records (orzo.CONTACT)."""
        count = ffi.new("int64_t *")
        check(lib.orzo_contacts(self._open_sim(), ffi.NULL, 0, count))
        rows = np.empty(count[0], CONTACT)
        pointer = ffi.cast("OrzoContact *", rows.ctypes.data)
        check(lib.orzo_contacts(self._sim, pointer, len(rows), count))
        return rows

    # Columns of series.csv

    @property
    def columns(self) -> list[str]:
        """Names of the columns of series.csv that the scene has."""
        self.start()
        names = range(lib.orzo_column_count(self._sim))
        return [ffi.string(lib.orzo_column(self._sim, k)).decode() for k in names]

    def observe(self, column: str) -> float:
        """A column's value now, in its unit (`orzo keys --columns`); nan where its cell would be empty."""
        value = ffi.new("double *")
        check(lib.orzo_observe(self._open_sim(), column.encode(), value))
        return value[0]

    def row(self) -> dict[str, float]:
        """All columns now."""
        names = self.columns
        values = ffi.new("double[]", len(names))
        check(lib.orzo_observe_all(self._sim, values, len(names)))
        return dict(zip(names, values))

    # From outside

    def push(self, force: Optional[ArrayLike], torque: Optional[ArrayLike] = None, grains: Optional[ArrayLike] = None) -> None:
        """From now on these forces (N) and torques (N m), (n, 3) each in the frame of the scene, act on the n grains whose
        numbers `grains` has (None: the first n) until they are set again; None: none. Rods and spheres only."""
        given = [None if a is None else np.ascontiguousarray(a, np.float64).reshape(-1, 3) for a in (force, torque)]
        ids = None if grains is None else np.ascontiguousarray(grains, np.int64).ravel()
        counts = {len(a) for a in (*given, ids) if a is not None}
        if len(counts) > 1:
            raise ValueError("expected as many forces as torques and grains")
        pointers = [ffi.NULL if a is None else ffi.cast("double *", a.ctypes.data) for a in given]
        numbers = ffi.NULL if ids is None else ffi.cast("int64_t *", ids.ctypes.data)
        check(lib.orzo_push(self._open_sim(), numbers, counts.pop() if counts else len(self), *pointers))

    def wall(self, wall: int) -> tuple[float, float]:
        """Offset (m) and velocity (m/s) of wall i along its motion."""
        values = ffi.new("double[2]")
        check(lib.orzo_wall(self._open_sim(), wall, values, values + 1))
        return values[0], values[1]

    def drive_wall(self, wall: int, speed: float) -> None:
        """From now on wall i, which has a motion in the scene, goes on at this speed, m/s, from where it is."""
        check(lib.orzo_drive_wall(self._open_sim(), wall, speed))

    def draw(self) -> NDArray[np.uint8]:
        """A picture as the scene's movie would be: (height, width, 4), RGBA."""
        size = ffi.new("int[2]")
        lib.orzo_picture_size(self._open_sim(), size, size + 1)
        pixels = np.empty((size[1], size[0], 4), np.uint8)
        check(lib.orzo_draw(self._sim, ffi.cast("uint8_t *", pixels.ctypes.data), pixels.size))
        return pixels
