# SPDX-License-Identifier: MIT
"""The shared library behind the package: geotherm.h, by ctypes."""

from __future__ import annotations

import ctypes
import functools
import json
import os
import sys
import threading
import time
import warnings
from collections.abc import Callable
from ctypes import POINTER, byref, c_char_p, c_double, c_int, c_int64, c_void_p
from pathlib import Path
from types import TracebackType
from typing import Any, Union

import numpy as np

_INTERFACE = 0  # GEOTHERM_INTERFACE of the header that this file follows
_CODES = (
    "ok",
    "bad-input",
    "bad-file",
    "not-available",
    "numerical-failure",
    "budget-ended",
    "out-of-memory",
    "cancelled",
    "no-device",
)
_BAD_INPUT, _CANCELLED = 1, 7

Progress = Union[bool, Callable[[str, float], Any], None]


class Error(Exception):
    """What could not be done, and why.

    Attributes:
        code: "bad-input", "bad-file", "not-available", "numerical-failure", "budget-ended",
            "out-of-memory", "cancelled" or "no-device".
        message: one sentence with the argument and the numbers.
        hint: what to do about it; "" where nothing is known to help.
    """

    def __init__(self, message: str, code: str = "bad-input", hint: str = "") -> None:
        super().__init__(f"{message}; {hint}" if hint else message)
        self.code = code
        self.message = message
        self.hint = hint

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.message, self.code, self.hint)


class InputError(Error, ValueError):
    """An Error about an argument: another one would work. A ValueError, too."""


class ResultWarning(UserWarning):
    """What there is to know of an answer that has no `warnings` itself: an array, lines, samples."""


class Array(ctypes.Structure):
    """geotherm_array."""

    _fields_ = [
        ("data", c_void_p),
        ("type", c_int),
        ("rows", c_int64),
        ("columns", c_int64),
        ("row_stride", c_int64),
        ("column_stride", c_int64),
    ]


_Callback = ctypes.CFUNCTYPE(c_int, c_void_p, c_char_p, c_double)


class _Watch(ctypes.Structure):
    _fields_ = [("progress", _Callback), ("data", c_void_p), ("interruptible", c_int)]


class Shape(ctypes.Structure):
    """geotherm_shape."""

    _fields_ = [
        ("kind", c_int),
        ("positions", Array),
        ("cells", Array),
        ("values", Array),
        ("starts", Array),
        ("size", c_int64 * 3),
        ("spacing", c_double * 3),
        ("origin", c_double * 3),
    ]


class Sources(ctypes.Structure):
    """geotherm_sources."""

    _fields_ = [
        ("points", c_void_p),
        ("count", c_int64),
        ("starts", c_void_p),
        ("sets", c_int64),
        ("text", c_char_p),
    ]


class Rows(ctypes.Structure):
    """geotherm_rows."""

    _fields_ = [
        ("array", Array),
        ("path", c_char_p),
        ("targets", c_void_p),
        ("target_count", c_int64),
        ("max_distance", c_double),
    ]


_Handles = POINTER(c_void_p)
_Text = POINTER(c_char_p)
_SIGNATURES: dict[str, tuple[Any, ...]] = {
    "last_error": (_Text, _Text),
    "options_new": (_Handles,),
    "options_set": (c_void_p, c_char_p, c_char_p),
    "options_get": (c_void_p, c_char_p, _Text),
    "features": (_Text,),
    "model_read": (c_char_p, c_void_p, c_void_p, _Handles),
    "model_build": (POINTER(Shape), c_void_p, c_void_p, _Handles),
    "solver_new": (c_void_p, c_void_p, c_void_p, _Handles),
    "solver_move": (c_void_p, POINTER(Array), c_void_p, _Handles, _Handles),
    "distance": (c_void_p, POINTER(Sources), POINTER(Array), c_void_p),
    "distances": (c_void_p, POINTER(Sources), POINTER(Rows), c_void_p),
    "solve": (c_void_p, POINTER(Sources), c_char_p, c_void_p, _Handles),
    "path": (c_void_p, POINTER(Sources), c_char_p, c_int, c_void_p, _Handles),
    "isolines": (c_void_p, POINTER(Array), POINTER(Array), c_void_p, _Handles),
    "samples": (c_void_p, c_int64, c_int64, c_void_p, _Handles),
    "log_map": (c_void_p, POINTER(Sources), c_char_p, c_double, c_void_p, _Handles),
    "centres": (
        c_void_p, POINTER(Sources), c_void_p, c_char_p, c_char_p, c_void_p, _Handles
    ),
    "relax": (c_void_p, POINTER(Sources), c_int64, c_void_p, _Handles),
    "paths": (c_void_p, POINTER(Sources), POINTER(Sources), c_void_p, _Handles),
    "trace": (c_void_p, POINTER(Sources), c_double, c_double, c_void_p, _Handles),
    "transport": (c_void_p, c_void_p, POINTER(Array), POINTER(Array), c_void_p, _Handles),
    "extend": (c_void_p, c_void_p, POINTER(Array), POINTER(Array), c_void_p, _Handles),
    "signed_distance": (
        c_void_p, c_void_p, POINTER(Sources), c_int, c_char_p, c_void_p, _Handles
    ),
    "array_of": (c_void_p, c_char_p, POINTER(Array)),
    "text_of": (c_void_p, c_char_p, _Text),
    "write": (c_void_p, c_char_p),
    "free": (c_void_p,),
}


def _candidates() -> list[str]:
    chosen = os.environ.get("GEOTHERM_LIBRARY")
    if chosen:
        return [chosen]
    beside = sorted(str(path) for path in Path(__file__).parent.glob("libgeotherm.so*"))
    return [*beside, f"libgeotherm.so.{_INTERFACE}"]


@functools.lru_cache(maxsize=None)
def library() -> ctypes.CDLL:
    """The library, loaded when it is first needed."""
    tried = []
    for name in _candidates():
        try:
            found = ctypes.CDLL(name)
        except OSError as why:
            tried.append(str(why))
            continue
        if not hasattr(found, "geotherm_interface"):
            raise ImportError(f"{name} is no library of geotherm; set GEOTHERM_LIBRARY to one")
        if found.geotherm_interface() != _INTERFACE:
            raise ImportError(
                f"{name} has the interface {found.geotherm_interface()}, and this package is made"
                f" for {_INTERFACE}; install both of one version"
            )
        found.geotherm_version.restype = c_char_p
        for function, arguments in _SIGNATURES.items():
            getattr(found, "geotherm_" + function).argtypes = arguments
        return found
    raise ImportError(
        f"geotherm's library was not found ({'; '.join(tried)}); install the package again, or set"
        " GEOTHERM_LIBRARY to libgeotherm.so"
    )


def _raise(status: int) -> None:
    message, hint = c_char_p(), c_char_p()
    library().geotherm_last_error(byref(message), byref(hint))
    kind = InputError if status == _BAD_INPUT else Error
    code = _CODES[status] if 0 <= status < len(_CODES) else "unknown"
    raise kind(_decoded(message.value), code, _decoded(hint.value))


def _decoded(text: bytes | None) -> str:
    return (text or b"").decode("utf-8", "replace")


def call(function: str, *arguments: Any) -> None:
    """Calls geotherm_FUNCTION, without the interpreter's lock. Raises Error."""
    status = getattr(library(), "geotherm_" + function)(*arguments)
    if status != 0:
        _raise(status)


class Handle:
    """A geotherm_... that is freed with its last user."""

    def __init__(self) -> None:
        self.value = c_void_p()

    def __del__(self) -> None:
        if self.value and ctypes is not None and sys.meta_path is not None:
            library().geotherm_free(self.value)

    def text(self, name: str) -> str:
        """geotherm_text_of()."""
        text = c_char_p()
        call("text_of", self.value, name.encode(), byref(text))
        return _decoded(text.value)


def create(function: str, *arguments: Any) -> Handle:
    """The handle that a function makes, which is its last argument."""
    handle = Handle()
    call(function, *arguments, byref(handle.value))
    return handle


def warned(handle: Handle) -> Handle:
    """An answer whose warnings nothing holds: they are ResultWarnings for the caller's caller."""
    for text in json.loads(handle.text("warnings")):
        warnings.warn(text, ResultWarning, stacklevel=3)
    return handle


def path_bytes(path: str | os.PathLike[str], argument: str) -> bytes:
    """A path as the library takes it."""
    try:
        return _without_zeros(os.fsencode(path), argument)
    except TypeError:
        raise InputError(f"{argument} is {type(path).__name__}, and no path") from None
    except UnicodeEncodeError:
        raise InputError(f"{argument} is {path!r}, which no file is called") from None


def text_bytes(text: str, argument: str) -> bytes:
    """A text as the library takes it."""
    if not isinstance(text, str):
        raise InputError(f"{argument} is {text!r}, and no text")
    try:
        return _without_zeros(text.encode("utf-8", "surrogateescape"), argument)
    except UnicodeEncodeError:
        raise InputError(f"{argument} is {text!r}, which is no text") from None


def _without_zeros(encoded: bytes, argument: str) -> bytes:
    if b"\0" in encoded:
        raise InputError(f"{argument} holds a zero byte")
    return encoded


def _tell_plainly() -> Callable[[str, float], None]:
    last = 0.0

    def tell(stage: str, share: float) -> None:
        nonlocal last
        now = time.monotonic()
        if now - last < 0.1 and share < 1:
            return
        last = now
        share_text = f"{100 * share:3.0f} %" if share >= 0 else ""
        print(f"\r{stage:<40.40} {share_text}", end="", file=sys.stderr, flush=True)

    return tell


class Watch:
    """Progress and cancelling of one call: a context whose `pointer` is the call's argument.

    Ctrl-C cancels where the call is made from the main thread. `progress` is a callable(stage,
    share), share 0 to 1, below 0 when unknown, which cancels by returning False or by raising; or
    True: a bar by tqdm, where that is installed, else a line on standard error.
    """

    def __init__(self, progress: Progress = None) -> None:
        self._raised: BaseException | None = None
        self._bar: Any = None
        self._said_stop = False
        self._plain = False
        self._tell: Callable[[str, float], Any] | None = None
        if progress is True:
            self._tell = self._begin_bar()
        elif callable(progress):
            self._tell = progress
        elif progress is not None and progress is not False:
            raise InputError(
                f"progress is {type(progress).__name__}",
                hint="give a callable(stage, share) or True",
            )

    def _begin_bar(self) -> Callable[[str, float], Any]:
        try:
            from tqdm.auto import tqdm  # type: ignore[import]
        except ImportError:
            self._plain = True
            return _tell_plainly()
        bar = self._bar = tqdm(total=100, unit="%")

        def tell(stage: str, share: float) -> None:
            bar.set_description(stage, refresh=False)
            if share >= 0:
                bar.update(100 * share - bar.n)

        return tell

    def _on_progress(self, _: int | None, stage: bytes, share: float) -> int:
        try:
            assert self._tell is not None
            answer = self._tell(_decoded(stage), share)
            self._said_stop = isinstance(answer, (bool, np.bool_)) and not answer
        except BaseException as raised:  # it is raised again where the call returns
            self._raised = raised
            return 1
        return int(self._said_stop)

    def __enter__(self) -> Watch:
        main = threading.current_thread() is threading.main_thread()
        callback = _Callback(self._on_progress) if self._tell else _Callback(0)
        self._watch = _Watch(callback, None, int(main))
        self.pointer = ctypes.cast(ctypes.pointer(self._watch), c_void_p)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        _: TracebackType | None,
    ) -> None:
        if self._bar is not None:
            self._bar.close()
        if self._plain:
            print(file=sys.stderr)
        if self._raised is not None:
            raise self._raised
        if isinstance(error, Error) and error.code == _CODES[_CANCELLED] and not self._said_stop:
            raise KeyboardInterrupt from None
