# SPDX-License-Identifier: MIT
"""Sources in all the forms that people write them in."""

from __future__ import annotations

import ctypes
import operator
from collections.abc import Iterable
from typing import Any

import numpy as np

from geotherm._arrays import AnyArray
from geotherm._library import InputError, Sources, text_bytes

_VERTEX, _FACE, _PLACE = range(3)
_RECORD = np.dtype([("kind", "i8"), ("id", "i8"), ("at", "f8", (3,)), ("offset", "f8")])


def _is_in_face(one: Any) -> bool:
    """Whether it is (face, weights)."""
    if not isinstance(one, tuple) or len(one) != 2:
        return False
    weights = one[1]
    if isinstance(weights, np.ndarray):
        return weights.ndim == 1
    numbers = (int, float, np.number)
    return isinstance(weights, (list, tuple)) and all(isinstance(w, numbers) for w in weights)


def _are_whole(items: Iterable[Any]) -> bool:
    return all(isinstance(item, (int, np.integer)) for item in items)


class Taken:
    """Sources as the library takes them. `sets`: each by itself, in place of all together."""

    def __init__(self, sources: Any, name: str = "sources", sets: bool = False) -> None:
        self._name = name
        self._texts: list[str] = []
        self._starts: list[int] = [0]
        self._parts: list[AnyArray] = []
        self._count = 0
        if sets:
            self._add_sets(sources)
        else:
            self._add(sources)
        self._join(sets)

    def _join(self, sets: bool) -> None:
        self.points = np.concatenate(self._parts) if self._parts else np.empty(0, _RECORD)
        starts = np.asarray(self._starts, np.int64)
        self._kept = (self.points, starts)
        single = len(starts) == self.points.size + 1 and bool((np.diff(starts) == 1).all())
        text = "\n".join(self._texts)
        self.struct = Sources(
            self.points.ctypes.data,
            self.points.size,
            starts.ctypes.data if sets and not single else None,
            len(starts) - 1,
            text_bytes(text, self._name) if text else None,
        )
        self.pointer = ctypes.byref(self.struct)
        self.set_count = len(starts) - 1
        self.has_text = bool(text)

    def texts(self) -> list[str]:
        """The sources as the command line writes them."""
        out = []
        for record in self.points:
            at = ":".join(repr(float(x)) for x in record["at"])
            forms = {_VERTEX: str(record["id"]), _FACE: f"face:{record['id']}:{at}"}
            out.append(forms.get(int(record["kind"]), f"xyz:{at}"))
        return out + self._texts

    def _wrong(self, what: str, hint: str = "") -> InputError:
        return InputError(f"{self._name} {what}", hint=hint)

    def _put(self, records: AnyArray) -> None:
        self._parts.append(records)
        self._count += records.size

    def _ids(self, ids: AnyArray) -> None:
        records = np.zeros(ids.size, _RECORD)
        records["id"] = ids
        self._put(records)

    def _places(self, places: AnyArray) -> None:
        records = np.zeros(len(places), _RECORD)
        records["kind"] = _PLACE
        records["at"] = places
        self._put(records)

    def _in_face(self, face: Any, weights: Any) -> None:
        at = np.asarray(weights, dtype=np.float64)
        if at.shape != (3,):
            raise self._wrong(f"has weights of the shape {at.shape} in face {face}", "give three")
        records = np.zeros(1, _RECORD)
        records["kind"] = _FACE
        records["id"] = operator.index(face)
        records["at"] = at
        self._put(records)

    def _array(self, array: AnyArray) -> None:
        if array.size == 0:
            raise self._wrong("is empty", "name at least one")
        if array.dtype.kind == "u" and int(array.max()) >= 2**63:
            raise self._wrong(f"holds {array.max()}, which is no vertex")
        if array.dtype.kind in "iu" and array.ndim <= 1:
            self._ids(array.reshape(-1))
        elif array.dtype.kind in "fiu" and array.ndim <= 2 and array.shape[-1:] == (3,):
            self._places(array.reshape(-1, 3).astype(np.float64))
        elif array.dtype.kind == "b" and array.ndim == 1:
            raise self._wrong("is a mask", "give numpy.flatnonzero() of it")
        else:
            raise self._wrong(
                f"is an array of {array.dtype} of the shape {array.shape}",
                "give vertex numbers, or places (n, 3)",
            )

    def _add(self, one: Any) -> None:
        """All of it, into the set that is being made."""
        if isinstance(one, str):
            if "\n" in one:
                raise self._wrong("holds a line end")
            self._texts.append(one)
        elif isinstance(one, (int, np.integer)) and not isinstance(one, bool):
            if not 0 <= one < 2**63:
                raise self._wrong(f"holds {one}, which is no vertex")
            self._ids(np.array([one], np.int64))
        elif isinstance(one, (bytes, bytearray)):
            raise self._wrong("holds bytes", "give text or vertex numbers")
        elif isinstance(one, np.ndarray):
            self._array(one)
        elif isinstance(one, tuple) and _is_in_face(one):
            try:
                self._in_face(one[0], one[1])
            except (TypeError, ValueError) as why:
                if isinstance(why, InputError):
                    raise
                raise self._wrong("holds a pair that is no (face, weights)") from None
        elif isinstance(one, Iterable):
            self._add_list(list(one))
        else:
            raise self._wrong(
                f"holds {one!r}",
                "give vertex numbers, (face, weights), places (n, 3) or text such as 'boundary'",
            )

    def _add_list(self, items: list[Any]) -> None:
        if not items:
            raise self._wrong("is empty", "name at least one")
        simple = _are_whole(items)
        numbers = all(isinstance(item, (int, float, np.number)) for item in items)
        if numbers and not simple and len(items) == 3:
            self._places(np.asarray([items], np.float64))  # one place
            return
        for item in items:
            if isinstance(item, (list, tuple)) and item and _are_whole(item):
                raise self._wrong(
                    "holds a list of whole numbers in a list, which may be vertices or a place",
                    "give one list of vertices, or places as floats or as numpy.array()",
                )
            self._add(item)

    def _add_sets(self, sources: Any) -> None:
        if isinstance(sources, (str, bytes, bytearray, int, np.integer)) or _is_in_face(sources):
            sources = [sources]
        if isinstance(sources, np.ndarray) and sources.ndim == 1 and sources.dtype.kind in "iu":
            self._array(sources)
            self._starts = list(range(sources.size + 1))
            return
        whole = isinstance(sources, np.ndarray) and sources.dtype.kind in "iu"
        if whole and sources.ndim == 2 and sources.shape[1] == 3:
            raise self._wrong(
                f"is an array of whole numbers of the shape {sources.shape}, whose rows may be sets "
                "of vertices or places",
                "give sets as lists of vertices, or places as floats",
            )
        if isinstance(sources, np.ndarray) and sources.ndim == 0:
            sources = [sources]
        if not isinstance(sources, Iterable):
            raise self._wrong(f"is {type(sources).__name__}", "give a list of sources")
        for one in sources:
            before = len(self._texts)
            self._add(one)
            if isinstance(one, str):
                continue
            if len(self._texts) > before:
                raise self._wrong(f"has a set that holds the text {self._texts[-1]!r}", "give numbers")
            if before:
                raise self._wrong(
                    f"has the text {self._texts[-1]!r} before what is no text",
                    "give the texts last",
                )
            self._starts.append(self._count)
        if len(self._starts) == 1 and not self._texts:
            raise self._wrong("is empty", "name at least one")
