from typing import Tuple, Union

import numpy as np
import numpy.typing as npt

HIT: np.dtype
"""t, u, v (float32), primitive, instance (uint32): 20 bytes."""
NEAREST_POINT: np.dtype
"""distance, point (x, y, z), u, v (float32), primitive, instance (uint32): 36 bytes."""
NO_PRIMITIVE: int

class Error(RuntimeError): ...
class UsageError(Error, ValueError): ...

class Structure:
    """An immutable acceleration structure. Rays are float32 (n, 8) as boxwood.rays() makes them; a ray that has NaN, an
    infinite or zero direction, or coordinates beyond 1e12 hits nothing."""

    def closest_hits(self, rays: npt.ArrayLike, *, threads: int = 1) -> npt.NDArray[np.void]:
        """HIT (n,): the nearest hit with t in [t_near, t_far]; t is inf and primitive NO_PRIMITIVE on a miss. `threads`: 0
        for as many as there are; the answers are the same."""
    def any_hits(self, rays: npt.ArrayLike, *, threads: int = 1) -> npt.NDArray[np.bool_]:
        """bool (n,): whether anything is hit with t in [t_near, t_far]."""
    def all_hits(self, rays: npt.ArrayLike) -> Tuple[npt.NDArray[np.int64], npt.NDArray[np.void]]:
        """(offsets, hits): int64 (n + 1,) and HIT. Those of ray i are hits[offsets[i]:offsets[i + 1]], in order of t, each
        triangle once."""
    def first_hits(self, rays: npt.ArrayLike, k: int) -> npt.NDArray[np.void]:
        """HIT (n, k): the first k hits of each ray, then misses."""
    def nearest_points(self, points: npt.ArrayLike, within: float = np.inf) -> npt.NDArray[np.void]:
        """NEAREST_POINT (n,): the nearest point of the surface for each of `points`, float32 (n, 3); none beyond the
        distance `within`. Runs on all processors. The first call of a structure's distances builds a tree for them."""
    def signed_distances(self, points: npt.ArrayLike) -> npt.NDArray[np.float32]:
        """float32 (n,): distances to the surface, negative inside. Raises Error unless the surface is closed."""
    @property
    def recipe(self) -> str: ...
    @property
    def bytes(self) -> int: ...
    @property
    def build_ms(self) -> float: ...
    @property
    def triangles(self) -> int: ...
    @property
    def left_out(self) -> int:
        """Triangles left out as degenerate or not finite."""

def build(vertices: npt.ArrayLike, faces: npt.ArrayLike, recipe: str = "default", threads: int = 0) -> Structure:
    """A structure over triangles: `vertices` float32 (n, 3) in world units, `faces` integers (m, 3), indices into them.
    Both are copied. `recipe` is any that `boxwood recipes` tells of; `threads` 0 for as many as there are. Raises
    UsageError for a bad recipe, shape or type, Error for an index out of range."""

def load(scene: str, recipe: str = "default", threads: int = 0) -> Structure:
    """The same of a file (OBJ, PLY, glTF, STL, pbrt, …) or of "generate:NAME(option=value, …)"."""

def rays(
    origins: npt.ArrayLike,
    directions: npt.ArrayLike,
    t_near: Union[float, npt.ArrayLike] = 0.0,
    t_far: Union[float, npt.ArrayLike] = np.inf,
) -> npt.NDArray[np.float32]:
    """float32 (n, 8): origin, t_near, direction, t_far in each row."""
