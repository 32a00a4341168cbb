// The queries of a structure: checks what it is given, and asks the layout.
#include <algorithm>

#include "boxwood/structure.h"
#include "layout/layout.h"
#include "query/hit_queries.h"
#include "recipe/capabilities.h"
#include "structure/same_length.h"

namespace boxwood {

Structure::Structure(std::shared_ptr<const Layout> layout, BuildReport report, Recipe recipe,
                     std::shared_ptr<const InstancePaths> paths)
    : layout_(std::move(layout)), report_(std::move(report)), recipe_(std::move(recipe)), paths_(std::move(paths)) {}

Hit Structure::closest_hit(const Ray& ray, std::uint32_t mask) const {
  if (mask == every_bit) return layout_->closest_hit(ray);
  Hit hit;
  if (mask != 0) hit_layout().closest_below(ray, {0, mask}, hit, nullptr);
  return hit;
}

bool Structure::any_hit(const Ray& ray, std::uint32_t mask) const {
  if (mask == every_bit) return layout_->any_hit(ray);
  return mask != 0 && hit_layout().any_below(ray, mask, nullptr);
}

void Structure::closest_hits(std::span<const Ray> rays, std::span<Hit> hits, Masks masks) const {
  check_same_length(rays.size(), hits.size());
  if (masks.empty()) return layout_->closest_hits(rays, hits);
  layout_for(masks, rays.size()).closest_hits_masked(rays, masks, hits);
  // Levels of triangles know no masks, so nothing is hidden there but from a ray that sees nothing.
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (masks[i] == 0) hits[i] = {};
  }
}

void Structure::any_hits(std::span<const Ray> rays, std::span<std::uint8_t> blocked, Masks masks) const {
  check_same_length(rays.size(), blocked.size());
  if (masks.empty()) return layout_->any_hits(rays, blocked);
  layout_for(masks, rays.size()).any_hits_masked(rays, masks, blocked);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (masks[i] == 0) blocked[i] = 0;
  }
}

void Structure::closest_hits_counted(std::span<const Ray> rays, std::span<Hit> hits,
                                     std::span<RayCounters> counters) const {
  check_same_length(rays.size(), hits.size());
  check_same_length(rays.size(), counters.size());
  layout_->closest_hits_counted(rays, hits, counters);
}

void Structure::any_hits_counted(std::span<const Ray> rays, std::span<std::uint8_t> blocked,
                                 std::span<RayCounters> counters) const {
  check_same_length(rays.size(), blocked.size());
  check_same_length(rays.size(), counters.size());
  layout_->any_hits_counted(rays, blocked, counters);
}

const Layout& Structure::hit_layout() const {
  for (const StageCall& call : recipe_.stages()) {
    if (answers_queries(*call.stage) && !has_capability(*call.stage, Capability::all_hits)) Layout::refuse_to_offer();
  }
  return *layout_;
}

const Layout& Structure::layout_for(Masks masks, std::size_t rays) const {
  if (masks.empty()) return *layout_;
  check_same_length(rays, masks.size());
  return hit_layout();
}

namespace {

std::uint32_t mask_of(Structure::Masks masks, std::size_t ray) { return masks.empty() ? every_bit : masks[ray]; }

Hit closest_below(const Layout& layout, const Ray& ray, std::uint32_t mask) {
  Hit hit;
  if (mask != 0) layout.closest_below(ray, {0, mask}, hit, nullptr);
  return hit;
}

}  // namespace

std::vector<Hit> Structure::all_hits(const Ray& ray, std::uint32_t mask) const {
  std::vector<Hit> hits;
  append_all_hits(hit_layout(), ray, mask, hits);
  return hits;
}

HitLists Structure::all_hits(std::span<const Ray> rays, Masks masks) const {
  layout_for(masks, rays.size());
  const Layout& layout = hit_layout();
  HitLists lists;
  lists.offsets.reserve(rays.size() + 1);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    append_all_hits(layout, rays[i], mask_of(masks, i), lists.hits);
    lists.offsets.push_back(lists.hits.size());
  }
  return lists;
}

std::size_t Structure::first_hits(const Ray& ray, std::span<Hit> hits, std::uint32_t mask) const {
  const std::size_t found = boxwood::first_hits(hit_layout(), ray, mask, hits);
  std::ranges::fill(hits.subspan(found), Hit{});
  return found;
}

void Structure::first_hits(std::span<const Ray> rays, std::size_t k, std::span<Hit> hits, Masks masks) const {
  check_answers_per_query(rays.size(), k, hits.size());
  layout_for(masks, rays.size());
  hit_layout();
  for (std::size_t i = 0; i < rays.size(); ++i) first_hits(rays[i], hits.subspan(i * k, k), mask_of(masks, i));
}

Hit Structure::closest_hit(const Ray& ray, HitFilter accept, std::uint32_t mask) const {
  return first_accepted(hit_layout(), ray, mask, 0, closest_hit(ray, mask), accept);
}

bool Structure::any_hit(const Ray& ray, HitFilter accept, std::uint32_t mask) const {
  return closest_hit(ray, accept, mask).valid();
}

void Structure::closest_hits(std::span<const Ray> rays, std::span<Hit> hits, HitFilter accept, Masks masks) const {
  const Layout& layout = hit_layout();
  closest_hits(rays, hits, masks);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    hits[i] = first_accepted(layout, rays[i], mask_of(masks, i), i, hits[i], accept);
  }
}

void Structure::any_hits(std::span<const Ray> rays, std::span<std::uint8_t> blocked, HitFilter accept,
                         Masks masks) const {
  const Layout& layout = hit_layout();
  check_same_length(rays.size(), blocked.size());
  layout_for(masks, rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const std::uint32_t mask = mask_of(masks, i);
    const Hit first = closest_below(layout, rays[i], mask);
    blocked[i] = first_accepted(layout, rays[i], mask, i, first, accept).valid() ? 1 : 0;
  }
}

}  // namespace boxwood
