// The Python module boxwood._core: NumPy arrays in and out, seen as the library's own types, nothing copied on the way.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cstring>
#include <memory>
#include <mutex>
#include <optional>

#include "boxwood/distance.h"
#include "boxwood/error.h"
#include "boxwood/moving.h"
#include "boxwood/scene.h"
#include "boxwood/structure.h"

namespace py = pybind11;

namespace boxwood {
namespace {

constexpr auto dense = py::array::c_style | py::array::forcecast;
using Floats = py::array_t<float, dense>;
using Masks = std::optional<py::array_t<std::uint32_t, dense>>;

[[noreturn]] void refuse_shape(const py::array& array, const char* name, const std::string& expected) {
  std::string shape;
  for (py::ssize_t i = 0; i < array.ndim(); ++i) shape += fmt::format("{}{}", i ? ", " : "", array.shape(i));
  throw UsageError(fmt::format("'{}' must have the shape {}, not ({})", name, expected, shape));
}

void check_columns(const py::array& array, py::ssize_t columns, const char* name) {
  if (array.ndim() != 2 || array.shape(1) != columns) refuse_shape(array, name, fmt::format("(n, {})", columns));
}

/// One for each of `count`; none when there is no array.
std::span<const std::uint32_t> masks_of(const Masks& masks, py::ssize_t count) {
  if (!masks) return {};
  if (masks->ndim() != 1 || masks->shape(0) != count) refuse_shape(*masks, "masks", fmt::format("({},)", count));
  return {masks->data(), static_cast<std::size_t>(count)};
}

std::span<const std::uint32_t> part_of(std::span<const std::uint32_t> masks, std::size_t begin, std::size_t count) {
  return masks.empty() ? masks : masks.subspan(begin, count);
}

/// Rows of floats as what they are to the library.
template <class Row>
std::span<const Row> rows_of(const Floats& array, const char* name) {
  check_columns(array, sizeof(Row) / sizeof(float), name);
  return {reinterpret_cast<const Row*>(array.data()), static_cast<std::size_t>(array.shape(0))};
}

template <class T>
std::span<T> span_of(py::array_t<T>& array) {
  return {array.mutable_data(), static_cast<std::size_t>(array.size())};
}

std::vector<Triangle> triangles_of(const py::array& faces) {
  check_columns(faces, 3, "faces");
  const char kind = faces.dtype().kind();
  if (kind != 'i' && kind != 'u') throw UsageError("'faces' must hold integers, indices into the vertices");
  const auto indices = py::array_t<std::int64_t, dense>::ensure(faces);
  std::vector<Triangle> out(static_cast<std::size_t>(faces.shape(0)));
  const std::int64_t* next = indices.data();
  for (std::size_t t = 0; t < out.size(); ++t) {
    for (std::uint32_t& corner : out[t]) {
      const std::int64_t index = *next++;
      if (index < 0 || index > 0xffffffff) throw UsageError(fmt::format("face {} has the index {}", t, index));
      corner = static_cast<std::uint32_t>(index);
    }
  }
  return out;
}

/// Answers do not depend on the cut: every ray is on its own.
template <class Trace>
void in_parallel(std::size_t rays, unsigned threads, const Trace& trace) {
  if (threads == 1) return trace(0, rays);
  tbb::task_arena(threads == 0 ? tbb::task_arena::automatic : static_cast<int>(threads)).execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays, 1 << 14),
                      [&](const auto& range) { trace(range.begin(), range.size()); });
  });
}

/// What can be asked of a structure of either kind.
class PyQueries {
 public:
  virtual ~PyQueries() = default;

  py::array_t<Hit> closest_hits(const Floats& array, const Masks& bits, unsigned threads) const {
    const auto rays = rows_of<Ray>(array, "rays");
    const auto masks = masks_of(bits, array.shape(0));
    py::array_t<Hit> out(array.shape(0));
    const auto hits = span_of(out);
    const py::gil_scoped_release release;
    const Structure structure = current();
    in_parallel(rays.size(), threads, [&](std::size_t begin, std::size_t count) {
      structure.closest_hits(rays.subspan(begin, count), hits.subspan(begin, count), part_of(masks, begin, count));
    });
    return out;
  }

  py::array_t<bool> any_hits(const Floats& array, const Masks& bits, unsigned threads) const {
    const auto rays = rows_of<Ray>(array, "rays");
    const auto masks = masks_of(bits, array.shape(0));
    py::array_t<bool> out(array.shape(0));
    static_assert(sizeof(bool) == sizeof(std::uint8_t));
    auto* blocked = reinterpret_cast<std::uint8_t*>(out.mutable_data());
    const py::gil_scoped_release release;
    const Structure structure = current();
    in_parallel(rays.size(), threads, [&](std::size_t begin, std::size_t count) {
      structure.any_hits(rays.subspan(begin, count), {blocked + begin, count}, part_of(masks, begin, count));
    });
    return out;
  }

  py::tuple all_hits(const Floats& array, const Masks& bits) const {
    const auto rays = rows_of<Ray>(array, "rays");
    const auto masks = masks_of(bits, array.shape(0));
    auto lists = std::make_unique<HitLists>();
    {
      const py::gil_scoped_release release;
      *lists = current().all_hits(rays, masks);
    }
    const auto offsets = static_cast<py::ssize_t>(lists->offsets.size());
    py::array_t<std::int64_t> starts(offsets);
    for (py::ssize_t i = 0; i < offsets; ++i) {
      starts.mutable_at(i) = static_cast<std::int64_t>(lists->offsets[static_cast<std::size_t>(i)]);
    }
    // The array owns the list that it shows.
    const HitLists* shown = lists.get();
    const py::capsule owner(lists.release(), [](void* list) { delete static_cast<HitLists*>(list); });
    return py::make_tuple(starts,
                          py::array_t<Hit>(static_cast<py::ssize_t>(shown->hits.size()), shown->hits.data(), owner));
  }

  py::array_t<Hit> first_hits(const Floats& array, std::size_t k, const Masks& bits) const {
    const auto rays = rows_of<Ray>(array, "rays");
    const auto masks = masks_of(bits, array.shape(0));
    py::array_t<Hit> out({array.shape(0), static_cast<py::ssize_t>(k)});
    const auto hits = span_of(out);
    const py::gil_scoped_release release;
    current().first_hits(rays, k, hits, masks);
    return out;
  }

  std::string recipe() const { return current().recipe().text(); }
  std::size_t bytes() const { return current().report().bytes; }
  double build_ms() const { return current().report().build_ms; }
  std::uint64_t triangles() const { return current().report().primitives; }
  std::uint64_t left_out() const { return current().report().left_out; }
  virtual std::string repr() const = 0;
  /// A copy, which other threads cannot change.
  virtual Structure current() const = 0;
};

/// A structure, with the scene that it was built of.
class PyStructure final : public PyQueries {
 public:
  PyStructure(Scene scene, const std::string& recipe, unsigned threads)
      : scene_(std::move(scene)), structure_(build(scene_, recipe, {.threads = threads})) {}

  py::array_t<NearestPoint> nearest_points(const Floats& array, float within) const {
    const auto points = rows_of<Vec3>(array, "points");
    py::array_t<NearestPoint> out(array.shape(0));
    const auto nearest = span_of(out);
    const py::gil_scoped_release release;
    distances().nearest_points(points, nearest, within);
    return out;
  }

  py::array_t<float> signed_distances(const Floats& array) const {
    const auto points = rows_of<Vec3>(array, "points");
    py::array_t<float> out(array.shape(0));
    const auto answers = span_of(out);
    const py::gil_scoped_release release;
    distances().signed_distances(points, answers);
    return out;
  }

  std::string repr() const override {
    return fmt::format("<boxwood.Structure of {} triangles, '{}'>", triangles(), recipe());
  }
  Structure current() const override { return structure_; }

 private:
  /// Built when first asked for, without Python's lock.
  const DistanceQueries& distances() const {
    std::call_once(once_, [&] { distances_.emplace(scene_); });
    return *distances_;
  }

  Scene scene_;
  Structure structure_;
  mutable std::once_flag once_;
  mutable std::optional<DistanceQueries> distances_;
};

/// A structure whose vertices move.
class PyMoving final : public PyQueries {
 public:
  PyMoving(Scene scene, const std::string& recipe, const MotionPolicy& policy, unsigned threads)
      : moving_(std::move(scene), recipe, policy, {.threads = threads}) {}

  py::dict refit(const Floats& vertices) {
    const auto positions = rows_of<Vec3>(vertices, "vertices");
    UpdateReport report;
    {
      const py::gil_scoped_release release;
      const std::lock_guard lock(mutex_);
      moving_.move_vertices(0, positions);
      report = moving_.update();
    }
    py::dict out;
    out["update_ms"] = report.update_ms;
    out["rebuilt_triangles"] = report.rebuilt_triangles;
    out["reason"] = report.reason;
    return out;
  }

  std::string why_no_refit() const {
    const std::lock_guard lock(mutex_);
    return moving_.why_no_refit();
  }
  double sah_ratio() const {
    const std::lock_guard lock(mutex_);
    const MotionQuality quality = moving_.quality();
    return quality.sah_cost_when_built > 0 ? quality.sah_cost / quality.sah_cost_when_built : 1;
  }
  std::string repr() const override {
    return fmt::format("<boxwood.MovingStructure of {} triangles, '{}'>", triangles(), recipe());
  }
  Structure current() const override {
    const std::lock_guard lock(mutex_);
    return moving_.structure();
  }

 private:
  mutable std::mutex mutex_;
  MovingStructure moving_;
};

/// Structures placed in one above them.
class PyPlaced final : public PyQueries {
 public:
  using Parts = std::vector<std::shared_ptr<PyQueries>>;

  PyPlaced(Parts parts, std::span<const Instance> instances, const std::string& recipe, unsigned threads)
      : parts_(std::move(parts)), structure_(place(structures(), instances, recipe, {.threads = threads})) {}

  std::uint32_t instance_numbers() const { return structure_.instance_numbers(); }
  std::vector<std::uint32_t> instance_path(std::uint32_t instance) const { return structure_.instance_path(instance); }
  std::string repr() const override {
    return fmt::format("<boxwood.PlacedStructure of {} instances, '{}'>", instance_numbers(), recipe());
  }
  Structure current() const override { return structure_; }

 private:
  std::vector<Structure> structures() const {
    std::vector<Structure> out;
    for (const auto& part : parts_) out.push_back(part->current());
    return out;
  }

  Parts parts_;  // some layouts read the meshes that they keep
  Structure structure_;
};

std::vector<Instance> instances_of(const Floats& transforms, const py::array_t<std::uint32_t, dense>& parts,
                                   const Masks& bits) {
  if (transforms.ndim() != 3 || transforms.shape(1) != 3 || transforms.shape(2) != 4) {
    refuse_shape(transforms, "transforms", "(n, 3, 4)");
  }
  const py::ssize_t count = transforms.shape(0);
  if (parts.ndim() != 1 || parts.shape(0) != count) refuse_shape(parts, "which", fmt::format("({},)", count));
  const auto masks = masks_of(bits, count);
  std::vector<Instance> out(static_cast<std::size_t>(count));
  const float* m = transforms.data();
  for (std::size_t i = 0; i < out.size(); ++i, m += 12) {
    out[i].mesh = parts.data()[i];
    out[i].object_to_world = {{m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}, {m[3], m[7], m[11]}};
    if (!masks.empty()) out[i].mask = masks[i];
  }
  return out;
}

std::shared_ptr<PyPlaced> place_parts(PyPlaced::Parts parts, const Floats& transforms,
                                      const py::array_t<std::uint32_t, dense>& which, const Masks& masks,
                                      const std::string& recipe, unsigned threads) {
  const std::vector<Instance> instances = instances_of(transforms, which, masks);
  const py::gil_scoped_release release;
  return std::make_shared<PyPlaced>(std::move(parts), instances, recipe, threads);
}

Rebuild rebuild_of(const std::string& name) {
  if (name == "when-it-pays") return Rebuild::when_it_pays;
  if (name == "never") return Rebuild::never;
  if (name == "worst-parts") return Rebuild::worst_parts;
  if (name == "all") return Rebuild::all;
  throw UsageError(fmt::format("'rebuild' is one of when-it-pays, never, worst-parts and all, not '{}'", name));
}

Scene scene_of(const Floats& vertices, const py::array& faces) {
  const auto positions = rows_of<Vec3>(vertices, "vertices");
  Scene scene;
  scene.add_mesh({positions.begin(), positions.end()}, triangles_of(faces));
  return scene;
}

std::shared_ptr<PyMoving> moving_arrays(const Floats& vertices, const py::array& faces, const std::string& recipe,
                                        const std::string& rebuild, double rays_per_update, double build_price,
                                        unsigned threads) {
  Scene scene = scene_of(vertices, faces);
  const MotionPolicy policy{rebuild_of(rebuild), rays_per_update, build_price};
  const py::gil_scoped_release release;
  return std::make_shared<PyMoving>(std::move(scene), recipe, policy, threads);
}

std::shared_ptr<PyStructure> build_arrays(const Floats& vertices, const py::array& faces, const std::string& recipe,
                                          unsigned threads) {
  Scene scene = scene_of(vertices, faces);
  const py::gil_scoped_release release;
  return std::make_shared<PyStructure>(std::move(scene), recipe, threads);
}

std::shared_ptr<PyStructure> build_file(const std::string& scene, const std::string& recipe, unsigned threads) {
  const py::gil_scoped_release release;
  return std::make_shared<PyStructure>(load(scene), recipe, threads);
}

}  // namespace
}  // namespace boxwood

PYBIND11_MODULE(_core, module) {
  using namespace boxwood;
  const py::arg rays("rays"), points("points");
  const py::arg_v masks = py::arg("masks") = py::none();
  // Raised by name in Python; a wrong request is a ValueError, too.
  static py::exception<Error> error(module, "Error", PyExc_RuntimeError);
  static py::exception<UsageError> usage(module, "UsageError", py::make_tuple(error, py::handle(PyExc_ValueError)));
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const UsageError& e) {
      usage(e.what());
    } catch (const Error& e) {
      error(e.what());
    }
  });
  PYBIND11_NUMPY_DTYPE(Vec3, x, y, z);
  PYBIND11_NUMPY_DTYPE(Hit, t, u, v, primitive, instance);
  PYBIND11_NUMPY_DTYPE(NearestPoint, distance, point, u, v, primitive, instance);
  module.attr("HIT") = py::dtype::of<Hit>();
  module.attr("NEAREST_POINT") = py::dtype::of<NearestPoint>();
  module.attr("NO_PRIMITIVE") = no_primitive;

  module.def("build", build_arrays, py::arg("vertices"), py::arg("faces"), py::arg("recipe") = "default",
             py::arg("threads") = 0);
  module.def("load", build_file, py::arg("scene"), py::arg("recipe") = "default", py::arg("threads") = 0);

  const float infinity = std::numeric_limits<float>::infinity();
  module.def("_place", place_parts, py::arg("parts"), py::arg("transforms"), py::arg("which"), masks, py::arg("recipe"),
             py::arg("threads"));
  py::class_<PyQueries, std::shared_ptr<PyQueries>>(module, "_Queries")
      .def("closest_hits", &PyQueries::closest_hits, rays, py::kw_only(), masks, py::arg("threads") = 1)
      .def("any_hits", &PyQueries::any_hits, rays, py::kw_only(), masks, py::arg("threads") = 1)
      .def("all_hits", &PyQueries::all_hits, rays, py::kw_only(), masks)
      .def("first_hits", &PyQueries::first_hits, rays, py::arg("k"), py::kw_only(), masks)
      .def_property_readonly("recipe", &PyQueries::recipe)
      .def_property_readonly("bytes", &PyQueries::bytes)
      .def_property_readonly("build_ms", &PyQueries::build_ms)
      .def_property_readonly("triangles", &PyQueries::triangles)
      .def_property_readonly("left_out", &PyQueries::left_out)
      .def("__repr__", &PyQueries::repr);
  py::class_<PyStructure, PyQueries, std::shared_ptr<PyStructure>>(module, "Structure")
      .def("nearest_points", &PyStructure::nearest_points, points, py::arg("within") = infinity)
      .def("signed_distances", &PyStructure::signed_distances, points);
  py::class_<PyPlaced, PyQueries, std::shared_ptr<PyPlaced>>(module, "PlacedStructure")
      .def_property_readonly("instance_numbers", &PyPlaced::instance_numbers)
      .def("instance_path", &PyPlaced::instance_path, py::arg("instance"));
  py::class_<PyMoving, PyQueries, std::shared_ptr<PyMoving>>(module, "MovingStructure")
      .def(py::init(&moving_arrays), py::arg("vertices"), py::arg("faces"), py::arg("recipe") = "default",
           py::arg("rebuild") = "when-it-pays", py::arg("rays_per_update") = MotionPolicy{}.rays_per_update,
           py::arg("build_price") = MotionPolicy{}.build_price, py::arg("threads") = 0)
      .def("refit", &PyMoving::refit, py::arg("vertices"))
      .def_property_readonly("why_no_refit", &PyMoving::why_no_refit)
      .def_property_readonly("sah_ratio", &PyMoving::sah_ratio);
}
