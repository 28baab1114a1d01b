# SPDX-License-Identifier: BSD-3-Clause
"""Places and directions as people have them, as arrays."""

from __future__ import annotations

import numpy as np


def places(values: object, parameter: str) -> np.ndarray:
    """One or several places as an array of shape (V, 3). ValueError for anything else."""
    array = _places(values)
    if array is None:
        raise ValueError(f"{parameter} must be numbers of shape (3,) or (V, 3), not {values!r}")
    return array


def _places(values: object) -> np.ndarray | None:
    """None for what is no numbers of that shape."""
    try:
        array = np.asarray(values)
    except ValueError:
        return None
    if array.shape[-1:] != (3,) or array.ndim > 2 or array.dtype.kind not in "fiu":
        return None
    return array.reshape(-1, 3).astype(float)


def place(values: object, parameter: str) -> np.ndarray:
    """A place as an array of shape (3,). ValueError for anything else."""
    array = _places(values)
    if array is None or len(array) != 1 or not np.isfinite(array).all():
        raise ValueError(f"{parameter} must be three numbers, not {values!r}")
    return array[0]


def direction(values: object, parameter: str) -> np.ndarray:
    """The same, not all 0."""
    array = place(values, parameter)
    if not array.any():
        raise ValueError(f"{parameter} must have a length, not {values!r}")
    return array
