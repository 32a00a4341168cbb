"""Boxwood: acceleration structures for rays and distances, on NumPy arrays.

    import boxwood
    structure = boxwood.build(vertices, faces)               # float32 (n, 3), integers (m, 3)
    hits = structure.closest_hits(boxwood.rays(origins, directions))
    hits["t"], hits["primitive"]                             # inf and NO_PRIMITIVE where nothing is hit

Arrays that are float32 and C-contiguous are read where they are; others are converted first. Python's lock is released
while the library works, so threads run beside each other.
"""

import numpy as _numpy

from ._core import (
    HIT,
    NEAREST_POINT,
    NO_PRIMITIVE,
    Error,
    MovingStructure,
    PlacedStructure,
    Structure,
    UsageError,
    _place,
    build,
    load,
)

__all__ = [
    "HIT",
    "NEAREST_POINT",
    "NO_PRIMITIVE",
    "Error",
    "MovingStructure",
    "PlacedStructure",
    "Structure",
    "UsageError",
    "build",
    "load",
    "place",
    "rays",
]


def place(parts, transforms, which=None, masks=None, recipe="default", threads=0):
    """Structures placed in one above them, each any number of times; what is placed may itself be placed structures.

    `parts` is a structure or a list of them; `transforms`, float32 (n, 3, 4), the maps to world space, translation in the
    last column; `which`, integers (n,), the part that each places (0); `masks`, uint32 (n,), bits of which a ray must
    have one in common with the instance to see it. `instance` of a hit counts what is placed: see instance_path().
    """
    parts = list(parts) if isinstance(parts, (list, tuple)) else [parts]
    transforms = _numpy.asarray(transforms, _numpy.float32)
    which = _numpy.zeros(len(transforms), _numpy.uint32) if which is None else _numpy.asarray(which)
    if which.size and (which.dtype.kind not in "iu" or which.min() < 0):
        raise UsageError("'which' must hold the numbers of parts, from 0")
    return _place(parts, transforms, which, masks, recipe, threads)


def rays(origins, directions, t_near=0.0, t_far=_numpy.inf):
    """Rays as an array of float32 with the shape (n, 8): origin, t_near, direction, t_far in each row.

    `origins` and `directions` have the shape (n, 3) or (3,); `t_near` and `t_far` are numbers or have the shape (n,), in
    units of the direction's length. This is how the library keeps rays: fill such an array yourself to save the copy.
    """
    origins, directions = _numpy.asarray(origins), _numpy.asarray(directions)
    count = max(1 if part.ndim == 1 else len(part) for part in (origins, directions))
    if origins.ndim == 2 and len(origins) == 0 or directions.ndim == 2 and len(directions) == 0:
        count = 0
    out = _numpy.empty((count, 8), _numpy.float32)
    out[:, 0:3] = origins
    out[:, 3] = t_near
    out[:, 4:7] = directions
    out[:, 7] = t_far
    return out
