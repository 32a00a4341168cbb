from typing import Any, Dict, List, Literal, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

HIT: np.dtype
"""t, u, v (float32), primitive, instance (uint32): 20 bytes."""
NEAREST_POINT: np.dtype
"""distance, point (x, y, z), u, v (float32), primitive, instance (uint32): 36 bytes."""
NO_PRIMITIVE: int

class Error(RuntimeError): ...
class UsageError(Error, ValueError): ...

class _Queries:
    """An immutable acceleration structure. Rays are float32 (n, 8) as boxwood.rays() makes them; a ray that has NaN, an
    infinite or zero direction, or coordinates beyond 1e12 hits nothing. `masks`, uint32 (n,), one for each ray: it sees
    only instances whose masks have a bit in common with its own."""

    def closest_hits(self, rays: npt.ArrayLike, *, masks: Optional[npt.ArrayLike] = None, threads: int = 1) -> npt.NDArray[np.void]:
        """HIT (n,): the nearest hit with t in [t_near, t_far]; t is inf and primitive NO_PRIMITIVE on a miss. `threads`: 0
        for as many as there are; the answers are the same."""
    def any_hits(self, rays: npt.ArrayLike, *, masks: Optional[npt.ArrayLike] = None, threads: int = 1) -> npt.NDArray[np.bool_]:
        """bool (n,): whether anything is hit with t in [t_near, t_far]."""
    def all_hits(self, rays: npt.ArrayLike, *, masks: Optional[npt.ArrayLike] = None) -> Tuple[npt.NDArray[np.int64], npt.NDArray[np.void]]:
        """(offsets, hits): int64 (n + 1,) and HIT. Those of ray i are hits[offsets[i]:offsets[i + 1]], in order of t, each
        triangle once."""
    def first_hits(self, rays: npt.ArrayLike, k: int, *, masks: Optional[npt.ArrayLike] = None) -> npt.NDArray[np.void]:
        """HIT (n, k): the first k hits of each ray, then misses."""
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

class Structure(_Queries):
    """One that stays as it was built."""

    def nearest_points(self, points: npt.ArrayLike, within: float = np.inf) -> npt.NDArray[np.void]:
        """NEAREST_POINT (n,): the nearest point of the surface for each of `points`, float32 (n, 3); none beyond the
        distance `within`. Runs on all processors. The first call of a structure's distances builds a tree for them."""
    def signed_distances(self, points: npt.ArrayLike) -> npt.NDArray[np.float32]:
        """float32 (n,): distances to the surface, negative inside. Raises Error unless the surface is closed."""

class PlacedStructure(_Queries):
    """Structures in one above them, as place() makes it."""

    @property
    def instance_numbers(self) -> int:
        """`instance` of a hit is below this."""
    def instance_path(self, instance: int) -> List[int]:
        """What was placed in what, from the outermost down: indices into `transforms` of each place()."""

class MovingStructure(_Queries):
    """One whose vertices move while its triangles stay what they are. Queries may run in other threads while it moves;
    each sees one state."""

    def __init__(
        self,
        vertices: npt.ArrayLike,
        faces: npt.ArrayLike,
        recipe: str = "default",
        rebuild: Literal["when-it-pays", "never", "worst-parts", "all"] = "when-it-pays",
        rays_per_update: float = 1e6,
        build_price: float = 50,
        threads: int = 0,
    ) -> None:
        """As build(). `rebuild` says when parts or all of it are built anew instead of refitted; "when-it-pays" expects
        `rays_per_update` rays between two moves and takes a build to cost `build_price` node visits and triangle tests
        per triangle. See docs/moving.md."""
    def refit(self, vertices: npt.ArrayLike) -> Dict[str, Any]:
        """Moves all vertices, float32 of the same shape as before, in world units. Returns what it took: update_ms (wall
        time), rebuilt_triangles, and reason, a sentence where something had to be built anew that should have been
        refitted, else empty. Raises UsageError on another shape."""
    @property
    def why_no_refit(self) -> str:
        """Why this recipe's trees cannot be refitted, so that refit() builds anew; empty when they can."""
    @property
    def sah_ratio(self) -> float:
        """Expected cost of a ray now over that when it was last built; 1 is as good as built. UsageError where nothing
        can be refitted."""

def build(vertices: npt.ArrayLike, faces: npt.ArrayLike, recipe: str = "default", threads: int = 0) -> Structure:
    """A structure over triangles: `vertices` float32 (n, 3) in world units, `faces` integers (m, 3), indices into them.
    Both are copied. `recipe` is any that `boxwood recipes` tells of; `threads` 0 for as many as there are. Raises
    UsageError for a bad recipe, shape or type, Error for an index out of range."""

def load(scene: str, recipe: str = "default", threads: int = 0) -> Structure:
    """The same of a file (OBJ, PLY, glTF, STL, pbrt, …) or of "generate:NAME(option=value, …)"."""

def place(
    parts: Union[_Queries, Sequence[_Queries]],
    transforms: npt.ArrayLike,
    which: Optional[npt.ArrayLike] = None,
    masks: Optional[npt.ArrayLike] = None,
    recipe: str = "default",
    threads: int = 0,
) -> PlacedStructure:
    """Structures placed in one above them: `transforms` float32 (n, 3, 4), maps to world space with the translation in the
    last column; `which` integers (n,), the part that each places (default 0); `masks` uint32 (n,), see _Queries. Up to 6
    levels. A moving structure is placed as it is now. Raises UsageError on a part that does not exist, Error on a map
    without inverse."""

def rays(
    origins: npt.ArrayLike,
    directions: npt.ArrayLike,
    t_near: Union[float, npt.ArrayLike] = 0.0,
    t_far: Union[float, npt.ArrayLike] = np.inf,
) -> npt.NDArray[np.float32]:
    """float32 (n, 8): origin, t_near, direction, t_far in each row."""
