"""The package against answers that are known, and against trying every triangle in NumPy."""

import threading

import numpy as np
import pytest

import boxwood


def soup(count, seed=1):
    random = np.random.default_rng(seed)
    centers = random.uniform(-1, 1, (count, 1, 3))
    vertices = (centers + random.uniform(-0.2, 0.2, (count, 3, 3))).reshape(-1, 3).astype(np.float32)
    return vertices, np.arange(3 * count).reshape(-1, 3)


def cube():
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], np.float32)
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return corners, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])


def some_rays(count, seed=2):
    random = np.random.default_rng(seed)
    origins = random.uniform(-2, 2, (count, 3))
    return boxwood.rays(origins, random.uniform(-1, 1, (count, 3)) - origins)


def every_triangle(vertices, faces, ray):
    """t of every triangle (inf where missed), in double precision."""
    a, b, c = (vertices[faces[:, i]].astype(float) for i in range(3))
    origin, direction = ray[0:3].astype(float), ray[4:7].astype(float)
    p = np.cross(direction, c - a)
    determinant = np.einsum("ij,ij->i", b - a, p)
    s = origin - a
    u = np.einsum("ij,ij->i", s, p) / determinant
    q = np.cross(s, b - a)
    v = q @ direction / determinant
    t = np.einsum("ij,ij->i", c - a, q) / determinant
    return np.where((u >= 0) & (v >= 0) & (u + v <= 1) & (t >= 0), t, np.inf)


@pytest.mark.parametrize("recipe", ["default", "fast", "spatial > wide(4)", "median > slab", "compact"])
def test_hits_are_those_of_every_triangle(recipe):
    vertices, faces = soup(300)
    structure = boxwood.build(vertices, faces, recipe)
    rays = some_rays(400)
    hits = structure.closest_hits(rays)
    offsets, all_hits = structure.all_hits(rays)
    first = structure.first_hits(rays, 2)
    assert hits.dtype == boxwood.HIT and hits.shape == (400,) and first.shape == (400, 2)
    for i, ray in enumerate(rays):
        expected = every_triangle(vertices, faces, ray)
        found = np.sort(expected[np.isfinite(expected)])
        mine = all_hits[offsets[i] : offsets[i + 1]]
        assert len(mine) == len(found)
        np.testing.assert_allclose(mine["t"], found, rtol=1e-4, atol=1e-5)
        np.testing.assert_array_equal(first[i][: len(mine)], mine[:2])
        if len(mine):
            assert hits[i] == mine[0]
        else:
            assert hits[i]["primitive"] == boxwood.NO_PRIMITIVE and np.isinf(hits[i]["t"])
    np.testing.assert_array_equal(structure.any_hits(rays), hits["primitive"] != boxwood.NO_PRIMITIVE)
    assert 50 < np.isfinite(hits["t"]).sum() < 400


def test_threads_change_nothing():
    structure = boxwood.build(*soup(500))
    rays = some_rays(50000)
    np.testing.assert_array_equal(structure.closest_hits(rays), structure.closest_hits(rays, threads=3))
    np.testing.assert_array_equal(structure.any_hits(rays), structure.any_hits(rays, threads=0))


def test_distances_to_a_cube():
    structure = boxwood.build(*cube())
    points = np.array([[0, 0, 0], [3, 0, 0], [0.5, 0, 0], [2, 2, 0], [0, 0, -1.5]], np.float32)
    np.testing.assert_allclose(structure.signed_distances(points), [-1, 2, -0.5, np.sqrt(2), 0.5], rtol=1e-6)
    nearest = structure.nearest_points(points)
    assert nearest.dtype == boxwood.NEAREST_POINT
    np.testing.assert_allclose(nearest["distance"], [1, 2, 0.5, np.sqrt(2), 0.5], rtol=1e-6)
    assert tuple(nearest["point"][1]) == (1, 0, 0)
    assert structure.nearest_points(points, within=1.7)["primitive"][1] == boxwood.NO_PRIMITIVE


def test_other_types_and_strides_are_converted():
    vertices, faces = soup(100)
    rays = some_rays(100)
    expected = boxwood.build(vertices, faces).closest_hits(rays)
    wide = np.zeros((100, 16), np.float32)
    wide[:, ::2] = rays
    for strange in (rays.astype(np.float64), np.asfortranarray(rays), wide[:, ::2], rays.tolist()):
        np.testing.assert_array_equal(boxwood.build(vertices.astype(float), faces.astype(np.int16)).closest_hits(strange), expected)


def test_hostile_input_has_an_answer_or_an_error():
    vertices, faces = cube()
    structure = boxwood.build(vertices, faces)
    bad = boxwood.rays([[np.nan, 0, 0], [0, 0, 0], [np.inf, 0, 0]], [[0, 0, 1], [0, 0, 0], [0, 0, 1]])
    assert (structure.closest_hits(bad)["primitive"] == boxwood.NO_PRIMITIVE).all()
    assert not structure.any_hits(bad).any()
    assert np.isinf(structure.nearest_points([[np.nan, 0, 0]])["distance"]).all()
    empty = boxwood.build(np.zeros((0, 3)), np.zeros((0, 3), int))
    assert not empty.any_hits(some_rays(10)).any()
    assert structure.closest_hits(np.zeros((0, 8))).shape == (0,)
    for wrong in (
        lambda: boxwood.build(vertices[:, :2], faces),
        lambda: boxwood.build(vertices, faces.astype(float)),
        lambda: boxwood.build(vertices, -faces),
        lambda: boxwood.build(vertices, faces, "no such recipe"),
        lambda: structure.closest_hits(np.zeros((3, 7))),
        lambda: structure.nearest_points(np.zeros(3)),
        lambda: structure.nearest_points(np.zeros((1, 3)), -1),
    ):
        with pytest.raises(boxwood.UsageError):
            wrong()
    with pytest.raises(boxwood.Error):
        boxwood.build(vertices, faces + 1)
    with pytest.raises(boxwood.Error):
        boxwood.build(vertices, faces[1:]).signed_distances(vertices)
    assert issubclass(boxwood.UsageError, ValueError)


def test_answers_outlive_the_structure():
    structure = boxwood.build(*soup(100))
    offsets, hits = structure.all_hits(some_rays(200))
    copy = hits.copy()
    del structure
    np.testing.assert_array_equal(hits, copy)


def test_the_lock_is_released():
    structure = boxwood.build(*soup(3000))
    rays = some_rays(200000)
    counted = 0
    worker = threading.Thread(target=lambda: [structure.closest_hits(rays) for _ in range(3)])
    worker.start()
    while worker.is_alive():
        counted += 1
    worker.join()
    assert counted > 100


def test_load():
    structure = boxwood.load("generate:random(triangles=200)", "fast")
    assert structure.triangles == 200
    assert "> wide(" in structure.recipe


@pytest.mark.parametrize("rebuild", ["when-it-pays", "never", "worst-parts", "all"])
def test_a_moving_structure_answers_as_one_built_anew(rebuild):
    vertices, faces = soup(500)
    moving = boxwood.MovingStructure(vertices, faces, rebuild=rebuild)
    rays = some_rays(300)
    random = np.random.default_rng(5)
    for _ in range(3):
        vertices = vertices + random.uniform(-0.1, 0.1, vertices.shape).astype(np.float32)
        report = moving.refit(vertices)
        assert report["update_ms"] >= 0 and report["reason"] == ""
        assert report["rebuilt_triangles"] <= 500 and (rebuild != "never" or report["rebuilt_triangles"] == 0)
        np.testing.assert_array_equal(moving.closest_hits(rays), boxwood.build(vertices, faces).closest_hits(rays))
    assert moving.sah_ratio > 1 if rebuild == "never" else moving.sah_ratio >= 0.5
    assert moving.why_no_refit == "" and "500 triangles" in repr(moving)


def test_a_moving_structure_says_what_it_cannot():
    vertices, faces = soup(50)
    moving = boxwood.MovingStructure(vertices, faces, "best")
    assert "cuts triangles" in moving.why_no_refit
    assert moving.refit(vertices)["rebuilt_triangles"] == 50
    with pytest.raises(boxwood.UsageError):
        moving.refit(vertices[:-1])
    with pytest.raises(ValueError):
        boxwood.MovingStructure(vertices, faces, rebuild="sometimes")


def moved(shift, turn=0.0):
    c, s = np.cos(turn), np.sin(turn)
    return np.array([[c, -s, 0, shift[0]], [s, c, 0, shift[1]], [0, 0, 1, shift[2]]], np.float32)


@pytest.mark.parametrize("recipe", ["default", "compact"])
def test_placed_structures_answer_as_their_triangles_would(recipe):
    vertices, faces = soup(40)
    box, sides = cube()
    transforms = np.stack([moved((3, 0, 0), 0.3), moved((-3, 1, 0)), moved((0, 4, 0), 1.0)])
    which = np.array([0, 0, 1])
    placed = boxwood.place(
        [boxwood.build(vertices, faces, recipe), boxwood.build(box, sides, recipe)], transforms, which
    )
    meshes = [(vertices, faces), (box, sides)]
    corners = [meshes[w][0] @ t[:, :3].T + t[:, 3] for w, t in zip(which, transforms)]
    rays = some_rays(300)
    rays[:, 0:3] *= 4
    hits = placed.closest_hits(rays)
    assert placed.instance_numbers == 3 and np.isfinite(hits["t"]).sum() > 20
    for i, ray in enumerate(rays):
        t = [every_triangle(c.astype(np.float32), meshes[w][1], ray).min() for c, w in zip(corners, which)]
        np.testing.assert_allclose(hits["t"][i], min(t), rtol=1e-3, atol=1e-4)
        if np.isfinite(min(t)):
            assert hits["instance"][i] == np.argmin(t)


def test_masks_choose_instances():
    part = boxwood.build(*cube())
    both = boxwood.place(part, [moved((0, 0, 0)), moved((0, 0, 5))], masks=[1, 2])
    rays = boxwood.rays([[0.1, 0.2, -9]] * 4, [0, 0, 1])
    masks = np.array([1, 2, 3, 4])
    np.testing.assert_allclose(both.closest_hits(rays, masks=masks)["t"], [8, 13, 8, np.inf])
    np.testing.assert_array_equal(both.any_hits(rays, masks=masks, threads=0), [True, True, True, False])
    np.testing.assert_array_equal(np.diff(both.all_hits(rays, masks=masks)[0]), [2, 2, 4, 0])
    np.testing.assert_allclose(both.first_hits(rays, 1, masks=masks)["t"][:, 0], [8, 13, 8, np.inf])
    with pytest.raises(boxwood.UsageError, match="'masks' must have the shape"):
        both.closest_hits(rays, masks=masks[:2])


def test_structures_in_structures_tell_the_way():
    pair = boxwood.place(boxwood.build(*cube()), [moved((0, 0, 0)), moved((10, 0, 0))])
    row = boxwood.place([pair], [moved((0, 0, 0)), moved((0, 20, 0))])
    del pair
    hit = row.closest_hits(boxwood.rays([[10, 20, -9]], [0, 0, 1]))[0]
    assert hit["t"] == 8 and row.instance_path(hit["instance"]) == [1, 1]


def test_wrong_placements_are_refused():
    part = boxwood.build(*cube())
    with pytest.raises(boxwood.UsageError, match="'transforms' must have the shape"):
        boxwood.place(part, np.eye(4)[None])
    with pytest.raises(boxwood.UsageError):
        boxwood.place(part, [moved((0, 0, 0))], which=[1])
    with pytest.raises(boxwood.UsageError, match="numbers of parts"):
        boxwood.place(part, [moved((0, 0, 0))], which=[-1])
    with pytest.raises(boxwood.Error):
        boxwood.place(part, np.zeros((1, 3, 4), np.float32))
