"""A torus: what a camera sees of it, through how much of it rays go, how far points are from it.

    python3 python/examples/first_rays.py
"""

import numpy as np

import boxwood

# %% A mesh: float32 (n, 3) and integers (m, 3).
rings, segments = 64, 128
u, v = np.meshgrid(np.arange(segments) * 2 * np.pi / segments, np.arange(rings) * 2 * np.pi / rings)
radius = 1 + 0.4 * np.cos(v)
vertices = np.stack([radius * np.cos(u), radius * np.sin(u), 0.4 * np.sin(v)], -1).reshape(-1, 3).astype(np.float32)
i, j = np.meshgrid(np.arange(segments), np.arange(rings))
a, b = j * segments + i, j * segments + (i + 1) % segments
c, d = (j + 1) % rings * segments + i, (j + 1) % rings * segments + (i + 1) % segments
faces = np.stack([a, b, d, a, d, c], -1).reshape(-1, 3)

structure = boxwood.build(vertices, faces)
print(structure, f"in {structure.build_ms:.1f} ms, {structure.bytes / structure.triangles:.0f} bytes per triangle")

# %% What is seen from above, as letters.
x, y = np.meshgrid(np.linspace(-1.6, 1.6, 64), np.linspace(1.6, -1.6, 32))
rays = boxwood.rays(np.stack([x, y, np.full_like(x, 5)], -1).reshape(-1, 3), [0, 0, -1])
hits = structure.closest_hits(rays)
depth = np.where(np.isfinite(hits["t"]), hits["t"], 5).reshape(x.shape)
for row in depth:
    print("".join(" .:-=+*#%@"[int(np.clip((5 - t) / 0.4 * 9, 0, 9))] for t in row))

# %% Through how much of it rays go: entries and exits, in order.
offsets, all_hits = structure.all_hits(boxwood.rays([[-5, 0.011, 0.013]], [1, 0, 0]))
t = all_hits["t"][offsets[0] : offsets[1]]
print("a line through the middle enters and leaves at", t, "and runs", (t[1::2] - t[::2]).sum(), "inside")

# %% How far from it points are; negative inside.
points = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0]], np.float32)
print("distances", structure.signed_distances(points), "at", structure.nearest_points(points)["point"])
