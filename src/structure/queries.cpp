// The queries of a structure: checks what it is given, and asks the layout.
#include <algorithm>

#include "boxwood/structure.h"
#include "layout/layout.h"
#include "query/hit_queries.h"
#include "recipe/capabilities.h"
#include "structure/same_length.h"

namespace boxwood {

Structure::Structure(std::shared_ptr<const Layout> layout, BuildReport report, Recipe recipe)
    : layout_(std::move(layout)), report_(std::move(report)), recipe_(std::move(recipe)) {}

Hit Structure::closest_hit(const Ray& ray) const { return layout_->closest_hit(ray); }

bool Structure::any_hit(const Ray& ray) const { return layout_->any_hit(ray); }

void Structure::closest_hits(std::span<const Ray> rays, std::span<Hit> hits) const {
  check_same_length(rays.size(), hits.size());
  layout_->closest_hits(rays, hits);
}

void Structure::any_hits(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const {
  check_same_length(rays.size(), blocked.size());
  layout_->any_hits(rays, blocked);
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

std::vector<Hit> Structure::all_hits(const Ray& ray) const {
  std::vector<Hit> hits;
  append_all_hits(hit_layout(), ray, hits);
  return hits;
}

HitLists Structure::all_hits(std::span<const Ray> rays) const {
  const Layout& layout = hit_layout();
  HitLists lists;
  lists.offsets.reserve(rays.size() + 1);
  for (const Ray& ray : rays) {
    append_all_hits(layout, ray, lists.hits);
    lists.offsets.push_back(lists.hits.size());
  }
  return lists;
}

std::size_t Structure::first_hits(const Ray& ray, std::span<Hit> hits) const {
  const std::size_t found = boxwood::first_hits(hit_layout(), ray, hits);
  std::ranges::fill(hits.subspan(found), Hit{});
  return found;
}

void Structure::first_hits(std::span<const Ray> rays, std::size_t k, std::span<Hit> hits) const {
  check_answers_per_query(rays.size(), k, hits.size());
  hit_layout();
  for (std::size_t i = 0; i < rays.size(); ++i) first_hits(rays[i], hits.subspan(i * k, k));
}

Hit Structure::closest_hit(const Ray& ray, HitFilter accept) const {
  return first_accepted(hit_layout(), ray, 0, layout_->closest_hit(ray), accept);
}

bool Structure::any_hit(const Ray& ray, HitFilter accept) const { return closest_hit(ray, accept).valid(); }

void Structure::closest_hits(std::span<const Ray> rays, std::span<Hit> hits, HitFilter accept) const {
  const Layout& layout = hit_layout();
  closest_hits(rays, hits);
  for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = first_accepted(layout, rays[i], i, hits[i], accept);
}

void Structure::any_hits(std::span<const Ray> rays, std::span<std::uint8_t> blocked, HitFilter accept) const {
  const Layout& layout = hit_layout();
  check_same_length(rays.size(), blocked.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    blocked[i] = first_accepted(layout, rays[i], i, layout.closest_hit(rays[i]), accept).valid() ? 1 : 0;
  }
}

}  // namespace boxwood
