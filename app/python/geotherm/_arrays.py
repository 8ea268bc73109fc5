# SPDX-License-Identifier: MIT
"""NumPy arrays in and out, without copies where the type fits."""

from __future__ import annotations

import ctypes
import operator
from typing import Any

import numpy as np
import numpy.typing as npt

from geotherm._library import Array, Handle, InputError, call, text_bytes

AnyArray = npt.NDArray[Any]

_TYPES: dict[str, int] = {"f8": 0, "f4": 1, "i8": 2, "i4": 3}
_DTYPES = [np.dtype(name) for name in _TYPES]
_NO_ARRAY = Array(None, 0, 0, 1, 0, 0)


def _typed(values: Any, name: str) -> AnyArray:
    """An array of a type that the library takes: the same one where it is that already."""
    try:
        array: AnyArray = np.asarray(values)
    except (ValueError, TypeError) as why:
        raise InputError(f"{name} is no array of numbers ({why})") from None
    if array.dtype in _DTYPES and array.dtype.isnative:
        return array
    if array.dtype.kind == "u" and array.size and int(array.max()) > np.iinfo(np.int64).max:
        raise InputError(f"{name} holds {array.max()}, which is above 2^63")
    if array.dtype.kind in "iub":
        return array.astype(np.int64)
    if array.dtype.kind == "f":
        return array.astype(np.float64)
    if array.size == 0 and array.dtype.kind == "O":
        return array.astype(np.float64)
    raise InputError(f"{name} is an array of {array.dtype}", hint="give numbers")


def described(array: AnyArray) -> Array:
    """The array as the library sees it; valid as long as that is."""
    rows = array.shape[0]
    columns = array.shape[1] if array.ndim == 2 else 1
    strides = (*array.strides, array.itemsize)[:2]
    code = _TYPES[f"{array.dtype.kind}{array.dtype.itemsize}"]
    return Array(array.ctypes.data, code, rows, columns, strides[0], strides[1])


def given(values: Any, name: str, columns: int) -> tuple[Array, AnyArray]:
    """Numbers for the library: (n, columns), or (n,) where `columns` is 1. Errors: InputError."""
    array = _typed(values, name)
    if columns == 1:
        fits, shape = array.ndim == 1, "(n,)"
    else:
        fits, shape = array.ndim == 2 and array.shape[1] == columns, f"(n, {columns})"
    if array.size == 0 and not fits and array.shape[0:1] == (0,):
        array = np.empty((0, columns) if columns > 1 else 0)
    elif not fits:
        raise InputError(f"{name} has the shape {array.shape}, and {shape} is expected")
    if array.size > 1 and not any(array.strides):
        array = array.copy()  # strides of 0 would mean: without gaps
    return described(array), array


def number_in(value: Any, name: str) -> float:
    """One number. Errors: InputError."""
    try:
        return float(value)
    except (TypeError, ValueError):
        raise InputError(f"{name} is {value!r}, and one number is expected") from None


def whole_in(value: Any, name: str) -> int:
    """One whole number of 64 bits. Errors: InputError."""
    try:
        number = operator.index(value)
    except TypeError:
        raise InputError(f"{name} is {value!r}, and one whole number is expected") from None
    if isinstance(value, bool) or not -(2**63) <= number < 2**63:
        raise InputError(f"{name} is {value!r}, which is no number of that kind")
    return number


def no_array() -> Array:
    """In place of an array that is not given."""
    return _NO_ARRAY


def output(
    out: AnyArray | None, shape: tuple[int, ...], dtype: npt.DTypeLike | None, name: str = "out"
) -> AnyArray:
    """The caller's array, or a new one. Errors: InputError, with what does not fit."""
    asked = None if dtype is None else _float_type(dtype)
    if out is None:
        return np.empty(shape, asked or np.float64)
    if not isinstance(out, np.ndarray):
        raise InputError(f"{name} is {type(out).__name__}, and no array")
    if out.shape != shape:
        raise InputError(f"{name} has the shape {out.shape}, and {shape} is written")
    if out.dtype not in _DTYPES[:2] or not out.dtype.isnative:
        raise InputError(f"{name} is an array of {out.dtype}", hint="give float64 or float32")
    if asked is not None and asked != out.dtype:
        raise InputError(f"{name} is an array of {out.dtype}, and dtype is {asked}")
    if not out.flags.writeable:
        raise InputError(f"{name} cannot be written to")
    if out.size > 1 and any(s == 0 and n > 1 for s, n in zip(out.strides, out.shape)):
        raise InputError(f"{name} has elements that share memory")
    return out


def _float_type(dtype: npt.DTypeLike) -> np.dtype[Any]:
    try:
        found = np.dtype(dtype)
    except TypeError:
        found = np.dtype(object)
    if found not in _DTYPES[:2]:
        raise InputError(f"dtype is {dtype!r}", hint="give float64 or float32")
    return found


class _Inside:
    """Memory of a handle, which it keeps."""

    def __init__(self, handle: Handle, array: Array) -> None:
        self.handle = handle
        shape = (array.rows,) if array.columns == 1 else (array.rows, array.columns)
        self.__array_interface__ = {
            "shape": shape,
            "typestr": _DTYPES[array.type].str,
            "data": (array.data or 0, True),
            "version": 3,
        }


def view(handle: Handle, name: str) -> AnyArray:
    """geotherm_array_of(): the library's own memory, read-only, kept by the array."""
    array = Array()
    call("array_of", handle.value, text_bytes(name, "name"), ctypes.byref(array))
    if array.rows == 0:
        shape = (0,) if array.columns == 1 else (0, array.columns)
        return np.empty(shape, _DTYPES[array.type])
    return np.asarray(_Inside(handle, array))
