# SPDX-License-Identifier: MIT
"""Means and medians of points on a surface."""

from __future__ import annotations

import ctypes
import json
from typing import Any

import numpy as np

from geotherm._arrays import AnyArray, given, view
from geotherm._library import Handle, Progress, Watch, create, text_bytes
from geotherm._models import Model, handle_of
from geotherm._sources import Taken


class Centres:
    """Means or medians that were found, the one of least energy first; the others are about as low.

    Attributes:
        points: (N, 3), model units.
        faces: (N,) int32, and weights: (N, 3): the points in these.
        energies: (N,): the sum of weight times distance^2 (of medians: distance) over that of the
            weights.
        residuals: (N,): the length of the step that was left to do.
        converged: (N,) bool.
        distances: (N, K), to the points.
        warnings: texts: where several are about as low, or a descent stalled.
    """

    def __init__(self, handle: Handle) -> None:
        self.points = view(handle, "points")
        self.faces = view(handle, "faces")
        self.weights = view(handle, "weights")
        self.energies = view(handle, "energies")
        self.residuals = view(handle, "residuals")
        self.converged: AnyArray = np.asarray(view(handle, "converged"), dtype=bool)
        self.distances: AnyArray = view(handle, "distances").reshape(len(self.energies), -1)
        self.warnings: list[str] = json.loads(handle.text("warnings"))

    def __len__(self) -> int:
        return len(self.energies)

    def __repr__(self) -> str:
        return f"<geotherm.Centres: {len(self)}, energy {self.energies[0]:g}>"


def centres(
    model: Model,
    points: Any,
    weights: Any = None,
    *,
    kind: str = "mean",
    method: str = "exact",
    progress: Progress = None,
) -> Centres:
    """Frechet means or medians of points: where the sum of weight times distance^2, or of weight
    times distance, is least.

    Args:
        model: a mesh.
        points: a list of vertices, (face, weights), places.
        weights: (K,), 0 or more; all 1 where there are none.
        kind: "mean" (Karcher 1977) or "median" (Fletcher, Venkatasubramanian, Joshi 2009).
        method: of the log maps: "exact", "wavefront", "wavefront-fine".

    >>> mean = geotherm.centres(mesh, [17, 99, 300])
    >>> mean.points.shape[1], mean.distances.shape[1]
    (3, 3)
    """
    taken = Taken(points, "points", sets=True)
    array, kept = (None, None) if weights is None else given(weights, "weights", 1)
    with Watch(progress) as watch:
        handle = create(
            "centres",
            handle_of(model),
            taken.pointer,
            None if array is None else ctypes.byref(array),
            text_bytes(kind, "kind"),
            text_bytes(method, "method"),
            watch.pointer,
        )
    del kept
    return Centres(handle)
