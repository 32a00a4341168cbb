// A structure over a scene that moves: which meshes are touched, and the level of instances above them.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <vector>

#include "boxwood/error.h"
#include "boxwood/moving.h"
#include "moving/moving_mesh.h"
#include "recipe/stage.h"
#include "structure/instance_paths.h"
#include "structure/mesh_geometry.h"
#include "structure/threads.h"

namespace boxwood {
namespace {

void check_policy(const MotionPolicy& policy) {
  if (policy.rays_per_update >= 0 && policy.build_price > 0) return;
  throw UsageError(fmt::format("a policy takes 0 or more rays per update and a positive build price, not {} and {}",
                               policy.rays_per_update, policy.build_price));
}

bool is_peer_recipe(const Recipe& recipe) { return recipe.stages().front().stage->kind == StageKind::peer; }

}  // namespace

struct MovingStructure::State {
  State(Scene of, const Recipe& with, const MotionPolicy& how, const BuildOptions& options)
      : scene(std::move(of)), recipe(with), policy(how), threads(options.threads), removed(scene.instances.size()) {
    check_policy(policy);
    if (needs_use(recipe)) {
      throw UsageError(
          fmt::format("'{}' is built for the rays of one view of one scene, which a scene that moves does not have",
                      recipe.text()));
    }
  }

  void check_mesh(std::uint32_t mesh) const {
    if (mesh < scene.meshes.size()) return;
    throw UsageError(fmt::format("there is no mesh {}; the scene has {}", mesh, scene.meshes.size()));
  }
  void check_instance(std::uint32_t instance) const {
    if (instance < scene.instances.size() && !removed[instance]) return;
    throw UsageError(fmt::format("there is no instance {}: {}", instance,
                                 instance < scene.instances.size()
                                     ? "it was removed"
                                     : fmt::format("the scene has had {}", scene.instances.size())));
  }

  void update(UpdateReport& report);
  void update_meshes(UpdateReport& report);
  std::shared_ptr<const Layout> place(BuildReport& report) const;
  Structure build_peer() const;

  Scene scene;
  Recipe recipe;
  MotionPolicy policy;
  unsigned threads;
  std::vector<std::unique_ptr<MovingMesh>> meshes;  ///< of our own layouts; empty for a peer
  std::vector<bool> moved;                          ///< per mesh that was built
  std::vector<bool> removed;                        ///< per instance
  std::optional<Structure> current;
};

void MovingStructure::State::update_meshes(UpdateReport& report) {
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    if (!moved[m]) continue;
    MovingMesh::Update done = meshes[m]->update(policy);
    ++(done.done == MovingMesh::Done::refitted  ? report.refitted
       : done.done == MovingMesh::Done::rebuilt ? report.rebuilt
                                                : report.rebuilt_in_part);
    report.rebuilt_triangles += done.rebuilt_triangles;
    if (report.reason.empty()) report.reason = std::move(done.reason);
    moved[m] = false;
  }
  for (std::size_t m = meshes.size(); m < scene.meshes.size(); ++m) {
    meshes.push_back(std::make_unique<MovingMesh>(scene, static_cast<std::uint32_t>(m), recipe));
    moved.push_back(false);
    ++report.rebuilt;
    report.rebuilt_triangles += meshes.back()->triangles();
  }
}

/// The level of instances, over what is left of them.
std::shared_ptr<const Layout> MovingStructure::State::place(BuildReport& report) const {
  std::vector<std::shared_ptr<const Layout>> bottoms;
  for (const auto& mesh : meshes) bottoms.push_back(mesh->layout());
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Box box = removed[i] ? Box{} : meshes[scene.instances[i].mesh]->bounds();
    boxes.push_back(box.empty() ? box : scene.instances[i].object_to_world.box(box));
  }
  Contents contents;
  contents.instances = scene.instances;
  contents.bottoms = bottoms;
  const Pipeline pipeline(recipe);
  pipeline.check_places_whole();
  Tree tree = pipeline.tree({instance_references(boxes), nullptr, nullptr});
  report.nodes += tree.nodes.size();
  report.bounds = tree.empty() ? Box{} : tree.nodes[0].bounds;
  auto layout = pipeline.encode(std::move(tree), contents);
  report.bytes += layout->bytes();
  add_facts(report.facts, layout->facts());
  return layout;
}

/// A peer is given the scene whole. What was removed is a mesh without triangles.
Structure MovingStructure::State::build_peer() const {
  if (std::ranges::find(removed, true) == removed.end()) return build(scene, recipe, {.threads = threads});
  Scene shown = scene;
  shown.meshes.emplace_back();
  for (std::size_t i = 0; i < removed.size(); ++i) {
    if (removed[i]) shown.instances[i].mesh = static_cast<std::uint32_t>(scene.meshes.size());
  }
  return build(shown, recipe, {.threads = threads});
}

void MovingStructure::State::update(UpdateReport& report) {
  // Given back first, so that meshes are refitted in place.
  current.reset();
  if (is_peer_recipe(recipe)) {
    current = build_peer();
    report.rebuilt = static_cast<std::uint32_t>(scene.meshes.size());
    report.rebuilt_triangles = scene.unique_triangles();
    report.reason = "a peer builds by itself, and its tree cannot be refitted";
    return;
  }
  update_meshes(report);
  BuildReport built;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const MovingMesh& mesh = *meshes[m];
    built.bytes += mesh.layout()->bytes();
    built.nodes += mesh.nodes();
    built.sah_cost += mesh.sah_cost();
    built.primitives += mesh.triangles();
    built.left_out += mesh.left_out();
    add_facts(built.facts, mesh.layout()->facts());
  }
  const bool single = scene.single_level() && !removed[0];
  if (single) built.bounds = meshes[0]->bounds();
  std::shared_ptr<const Layout> layout = single ? meshes[0]->layout() : place(built);
  report.placed_anew = !single;
  std::shared_ptr<const InstancePaths> paths;
  if (!single) paths = std::make_shared<const InstancePaths>(static_cast<std::uint32_t>(scene.instances.size()));
  current.emplace(std::move(layout), std::move(built), recipe, std::move(paths));
}

MovingStructure::MovingStructure(Scene scene, const Recipe& recipe, const MotionPolicy& policy,
                                 const BuildOptions& options)
    : state_(std::make_unique<State>(std::move(scene), recipe, policy, options)) {
  update();
}

MovingStructure::MovingStructure(Scene scene, std::string_view recipe, const MotionPolicy& policy,
                                 const BuildOptions& options)
    : MovingStructure(std::move(scene), Recipe::parse(recipe), policy, options) {}

MovingStructure::MovingStructure(MovingStructure&&) noexcept = default;
MovingStructure& MovingStructure::operator=(MovingStructure&&) noexcept = default;
MovingStructure::~MovingStructure() = default;

Structure MovingStructure::structure() const {
  if (!state_->current) throw Error("the last update failed, so there is no structure; update once more");
  return *state_->current;
}

const Scene& MovingStructure::scene() const { return state_->scene; }

std::string MovingStructure::why_no_refit(std::uint32_t mesh) const {
  state_->check_mesh(mesh);
  if (is_peer_recipe(state_->recipe)) return "a peer builds by itself, and its tree cannot be refitted";
  return mesh < state_->meshes.size() ? state_->meshes[mesh]->why_no_refit() : std::string();
}

MotionQuality MovingStructure::quality(std::uint32_t mesh) const {
  state_->check_mesh(mesh);
  if (const std::string reason = why_no_refit(mesh); !reason.empty()) {
    throw UsageError(fmt::format("mesh {} has no quality that changes: {}", mesh, reason));
  }
  return mesh < state_->meshes.size() ? state_->meshes[mesh]->quality() : MotionQuality{};
}

void MovingStructure::move_vertices(std::uint32_t mesh, std::span<const Vec3> positions) {
  state_->check_mesh(mesh);
  std::vector<Vec3>& old = state_->scene.meshes[mesh].positions;
  if (positions.size() != old.size()) {
    throw UsageError(fmt::format("mesh {} has {} vertices and cannot move to {}; add a new mesh instead", mesh,
                                 old.size(), positions.size()));
  }
  std::ranges::copy(positions, old.begin());
  if (mesh < state_->moved.size()) state_->moved[mesh] = true;
}

std::uint32_t MovingStructure::add_mesh(Mesh mesh) {
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) {
      if (vertex < mesh.positions.size()) continue;
      throw Error(fmt::format("the mesh refers to vertex {} of {}", vertex, mesh.positions.size()));
    }
  }
  state_->scene.meshes.push_back(std::move(mesh));
  return static_cast<std::uint32_t>(state_->scene.meshes.size() - 1);
}

void MovingStructure::move_instance(std::uint32_t instance, const Transform& object_to_world) {
  state_->check_instance(instance);
  state_->scene.instances[instance].object_to_world = object_to_world;
}

std::uint32_t MovingStructure::add_instance(const Instance& instance) {
  state_->check_mesh(instance.mesh);
  state_->scene.instances.push_back(instance);
  state_->removed.push_back(false);
  return static_cast<std::uint32_t>(state_->scene.instances.size() - 1);
}

void MovingStructure::remove_instance(std::uint32_t instance) {
  state_->check_instance(instance);
  state_->removed[instance] = true;
}

void MovingStructure::set_policy(const MotionPolicy& policy) {
  check_policy(policy);
  state_->policy = policy;
}

UpdateReport MovingStructure::update() {
  UpdateReport report;
  const auto begin = std::chrono::steady_clock::now();
  run_on_threads(state_->threads, [&] { state_->update(report); });
  report.update_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  return report;
}

}  // namespace boxwood
