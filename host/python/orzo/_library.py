"""liborzo through cffi: its declarations are read from its own header, its failures become exceptions."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Any

import cffi

_FOLDER = Path(__file__).parent


class OrzoError(RuntimeError):
    """A call failed; the text says what happened and what was expected."""


class InputError(OrzoError, ValueError):
    """A scene, a key, a name or a size is wrong."""


class DeviceError(OrzoError):
    """There is no OpenCL device, or it refused."""


class BlowupError(OrzoError):
    """A guard stopped the simulation: its state can still be read."""


def _declarations(header: str) -> tuple[str, dict[str, tuple[int, str]]]:
    """What cffi reads of the header; and the fields of its list: values a grain, unit."""
    fields = {
        name: (int(width), unit)
        for name, width, unit in re.findall(r'X\([A-Z_]+, (\w+), (\d), "([^"]*)"\)', header)
    }
    text = re.sub(r"/\*.*?\*/", "", header, flags=re.S)
    text = re.sub(r"^#(?:.*\\\n)*.*$", "", text, flags=re.M)
    text = re.sub(r'extern "C" \{|^\}$|ORZO_API ', "", text, flags=re.M)
    constants = ", ".join(f"ORZO_{name.upper()}" for name in fields)
    text = text.replace("ORZO_FIELDS(ORZO_FIELD)", constants + ",")
    return text, fields


ffi = cffi.FFI()
_text, FIELDS = _declarations((_FOLDER / "orzo.h").read_text(encoding="utf-8"))
ffi.cdef(_text)
lib: Any = ffi.dlopen(os.environ.get("ORZO_LIBRARY", str(_FOLDER / "liborzo.so")))

_ERRORS = {lib.ORZO_ERR_INPUT: InputError, lib.ORZO_ERR_DEVICE: DeviceError, lib.ORZO_ERR_BLOWUP: BlowupError}


def check(status: int) -> None:
    """Raises what a call's status says."""
    if status == lib.ORZO_ERR_MEMORY:
        raise MemoryError(error())
    if status != lib.ORZO_OK:
        raise _ERRORS.get(status, OrzoError)(error())


def error() -> str:
    return ffi.string(lib.orzo_error()).decode(errors="replace")


def version() -> str:
    """The library's version."""
    return ffi.string(lib.orzo_version()).decode()
