#ifdef BOXWOOD_EMBREE
#include "layout/embree/embree_user.h"

#include <algorithm>

#include "layout/embree/embree_ray.h"
#include "layout/embree/embree_scene.h"

namespace boxwood {
namespace {

class EmbreeUserLayout final : public Layout {
 public:
  EmbreeUserLayout(const Scene& scene, const EmbreeOptions& options) : scene_(scene, options) {
    for (const Instance& instance : scene.instances) world_to_object_.push_back(instance.object_to_world.inverse());
  }

  Hit closest_hit(const Ray& ray) const override {
    EmbreeUserQuery query = query_of(ray);
    return intersect(ray, query);
  }
  bool any_hit(const Ray& ray) const override {
    EmbreeUserQuery query = query_of(ray);
    return occluded(ray, query);
  }
  void closest_hits(std::span<const Ray> rays, std::span<Hit> hits) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = closest_hit(rays[i]);
  }
  void any_hits(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) blocked[i] = any_hit(rays[i]) ? 1 : 0;
  }
  void closest_hits_counted(std::span<const Ray> rays, std::span<Hit> hits,
                            std::span<RayCounters> counters) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      EmbreeUserQuery query = query_of(rays[i]);
      hits[i] = intersect(rays[i], query);
      counters[i] = {.primitive_tests = query.tests};
    }
  }
  void any_hits_counted(std::span<const Ray> rays, std::span<std::uint8_t> blocked,
                        std::span<RayCounters> counters) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      EmbreeUserQuery query = query_of(rays[i]);
      blocked[i] = occluded(rays[i], query) ? 1 : 0;
      counters[i] = {.primitive_tests = query.tests};
    }
  }
  std::size_t bytes() const override { return scene_.bytes(); }

 private:
  EmbreeUserQuery query_of(const Ray& ray) const {
    EmbreeUserQuery query;
    query.context = incoherent();
    query.ray = ray;
    query.ray.t_near = std::max(ray.t_near, 0.0f);  // Embree knows no other
    query.world_to_object = world_to_object_.data();
    return query;
  }

  Hit intersect(const Ray& ray, EmbreeUserQuery& query) const {
    RTCRayHit hit = to_query(ray);
    rtcIntersect1(scene_.handle(), &query.context, &hit);
    return query.best;
  }

  bool occluded(const Ray& ray, EmbreeUserQuery& query) const {
    RTCRay embree_ray = to_embree(ray);
    if (embree_ray.tnear > embree_ray.tfar) return false;
    rtcOccluded1(scene_.handle(), &query.context, &embree_ray);
    return embree_ray.tfar < 0;
  }

  EmbreeScene scene_;
  std::vector<Transform> world_to_object_;
};

}  // namespace

std::shared_ptr<const Layout> make_embree_user_layout(const Scene& scene, const EmbreeOptions& options) {
  return std::make_shared<EmbreeUserLayout>(scene, options);
}

}  // namespace boxwood
#endif
