// Embree 3 (Wald, Woop, Benthin, Johnson, Ernst 2014) as a peer: its builder, its kernels, our rays. Its triangle test
// is its own, so t may differ in the last bits, and on equal distance any of the triangles may win.
#ifdef BOXWOOD_EMBREE
#include <algorithm>
#include <array>
#include <cmath>

#include "layout/embree/embree_scene.h"
#include "layout/layout.h"
#include "layout/stages.h"

namespace boxwood {
namespace {

/// Ray's limits, as the kernels of our own see them.
bool within_limits(const Ray& ray) {
  const auto size = [](const Vec3& v) { return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}); };
  return is_finite(ray.origin) && is_finite(ray.direction) && size(ray.origin) <= largest_coordinate &&
         size(ray.direction) <= largest_coordinate && size(ray.direction) >= 1 / largest_coordinate &&
         ray.t_near <= ray.t_far;
}

/// Embree wants t_near >= 0 and takes a negative t_far for a hit; invalid rays become ones that cannot hit.
RTCRay to_embree(const Ray& ray) {
  const bool valid = within_limits(ray) && ray.t_far >= 0;
  RTCRay out{};
  out.org_x = valid ? ray.origin.x : 0, out.org_y = valid ? ray.origin.y : 0, out.org_z = valid ? ray.origin.z : 0;
  out.dir_x = valid ? ray.direction.x : 1, out.dir_y = valid ? ray.direction.y : 0;
  out.dir_z = valid ? ray.direction.z : 0;
  out.tnear = valid ? std::max(ray.t_near, 0.0f) : 1;
  out.tfar = valid ? ray.t_far : 0;
  out.mask = 0xffffffffu;
  return out;
}

RTCRayHit to_query(const Ray& ray) {
  RTCRayHit query{};
  query.ray = to_embree(ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

RTCIntersectContext incoherent() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  return context;
}

class EmbreeLayout final : public Layout {
 public:
  EmbreeLayout(const Scene& scene, const EmbreeOptions& options) : scene_(scene, options), batch_(options.batch) {}

  Hit closest_hit(const Ray& ray) const override {
    RTCRayHit query = to_query(ray);
    RTCIntersectContext context = incoherent();
    rtcIntersect1(scene_.handle(), &context, &query);
    return hit_of(query.ray.tfar, query.hit);
  }

  bool any_hit(const Ray& ray) const override {
    RTCRay query = to_embree(ray);
    if (query.tnear > query.tfar) return false;
    RTCIntersectContext context = incoherent();
    rtcOccluded1(scene_.handle(), &context, &query);
    return query.tfar < 0;
  }

  void closest_hits(std::span<const Ray> rays, std::span<Hit> hits) const override {
    switch (batch_) {
      case EmbreeBatch::single:
        for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = closest_hit(rays[i]);
        break;
      case EmbreeBatch::packet16:
        for (std::size_t i = 0; i < rays.size(); i += 16) {
          const std::size_t count = std::min<std::size_t>(16, rays.size() - i);
          intersect_packet(rays.subspan(i, count), hits.subspan(i, count));
        }
        break;
      case EmbreeBatch::stream:
        for (std::size_t i = 0; i < rays.size(); i += stream_size) {
          const std::size_t count = std::min(stream_size, rays.size() - i);
          intersect_stream(rays.subspan(i, count), hits.subspan(i, count));
        }
        break;
    }
  }

  void any_hits(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const override {
    switch (batch_) {
      case EmbreeBatch::single:
        for (std::size_t i = 0; i < rays.size(); ++i) blocked[i] = any_hit(rays[i]) ? 1 : 0;
        break;
      case EmbreeBatch::packet16:
        for (std::size_t i = 0; i < rays.size(); i += 16) {
          const std::size_t count = std::min<std::size_t>(16, rays.size() - i);
          occluded_packet(rays.subspan(i, count), blocked.subspan(i, count));
        }
        break;
      case EmbreeBatch::stream:
        for (std::size_t i = 0; i < rays.size(); i += stream_size) {
          const std::size_t count = std::min(stream_size, rays.size() - i);
          occluded_stream(rays.subspan(i, count), blocked.subspan(i, count));
        }
        break;
    }
  }

  /// What happens inside Embree cannot be counted.
  void closest_hits_counted(std::span<const Ray> rays, std::span<Hit> hits,
                            std::span<RayCounters> counters) const override {
    std::ranges::fill(counters, RayCounters{});
    closest_hits(rays, hits);
  }
  void any_hits_counted(std::span<const Ray> rays, std::span<std::uint8_t> blocked,
                        std::span<RayCounters> counters) const override {
    std::ranges::fill(counters, RayCounters{});
    any_hits(rays, blocked);
  }

  std::size_t bytes() const override { return scene_.bytes(); }

 private:
  static constexpr std::size_t stream_size = 256;  // rays per call that its documentation recommends as enough

  Hit hit_of(float t, std::uint32_t geometry, std::uint32_t instance_or_none, std::uint32_t primitive, float u,
             float v) const {
    if (geometry == RTC_INVALID_GEOMETRY_ID) return {};
    const std::uint32_t instance = instance_or_none == RTC_INVALID_GEOMETRY_ID ? 0 : instance_or_none;
    return {t, u, v, scene_.primitive_of(instance, primitive), instance};
  }
  Hit hit_of(float t, const RTCHit& hit) const {
    return hit_of(t, hit.geomID, hit.instID[0], hit.primID, hit.u, hit.v);
  }

  template <class Packet>
  static void fill_packet(std::span<const Ray> rays, Packet& packet, std::array<int, 16>& valid) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const RTCRay ray = to_embree(rays[i]);
      valid[i] = ray.tnear <= ray.tfar ? -1 : 0;
      packet.org_x[i] = ray.org_x, packet.org_y[i] = ray.org_y, packet.org_z[i] = ray.org_z;
      packet.dir_x[i] = ray.dir_x, packet.dir_y[i] = ray.dir_y, packet.dir_z[i] = ray.dir_z;
      packet.tnear[i] = ray.tnear, packet.tfar[i] = ray.tfar;
      packet.time[i] = 0, packet.mask[i] = ray.mask, packet.id[i] = 0, packet.flags[i] = 0;
    }
  }

  void intersect_packet(std::span<const Ray> rays, std::span<Hit> hits) const {
    RTCRayHit16 packet;
    alignas(64) std::array<int, 16> valid{};
    fill_packet(rays, packet.ray, valid);
    std::ranges::fill(packet.hit.geomID, RTC_INVALID_GEOMETRY_ID);
    std::ranges::fill(packet.hit.instID[0], RTC_INVALID_GEOMETRY_ID);
    RTCIntersectContext context = incoherent();
    rtcIntersect16(valid.data(), scene_.handle(), &context, &packet);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      hits[i] = hit_of(packet.ray.tfar[i], packet.hit.geomID[i], packet.hit.instID[0][i], packet.hit.primID[i],
                       packet.hit.u[i], packet.hit.v[i]);
    }
  }

  void occluded_packet(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const {
    RTCRay16 packet;
    alignas(64) std::array<int, 16> valid{};
    fill_packet(rays, packet, valid);
    RTCIntersectContext context = incoherent();
    rtcOccluded16(valid.data(), scene_.handle(), &context, &packet);
    for (std::size_t i = 0; i < rays.size(); ++i) blocked[i] = valid[i] != 0 && packet.tfar[i] < 0 ? 1 : 0;
  }

  void intersect_stream(std::span<const Ray> rays, std::span<Hit> hits) const {
    std::array<RTCRayHit, stream_size> queries;
    std::ranges::transform(rays, queries.begin(), to_query);
    RTCIntersectContext context = incoherent();
    rtcIntersect1M(scene_.handle(), &context, queries.data(), static_cast<unsigned>(rays.size()), sizeof(RTCRayHit));
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = hit_of(queries[i].ray.tfar, queries[i].hit);
  }

  void occluded_stream(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const {
    std::array<RTCRay, stream_size> queries;
    std::ranges::transform(rays, queries.begin(), to_embree);
    RTCIntersectContext context = incoherent();
    rtcOccluded1M(scene_.handle(), &context, queries.data(), static_cast<unsigned>(rays.size()), sizeof(RTCRay));
    for (std::size_t i = 0; i < rays.size(); ++i) blocked[i] = queries[i].tfar < 0 ? 1 : 0;
  }

  EmbreeScene scene_;
  EmbreeBatch batch_;
};

}  // namespace

Stage embree_stage() {
  Stage stage = describe(StageKind::peer, "embree", "Intel's ray tracing kernels, builder and traversal",
                         "Wald, Woop, Benthin, Johnson, Ernst 2014",
                         OptionsOf<EmbreeOptions>()
                             .choice("quality", &EmbreeOptions::quality, {"low", "medium", "high"}, "of the build")
                             .flag("robust", &EmbreeOptions::robust, "avoid optimizations that cost precision")
                             .flag("compact", &EmbreeOptions::compact, "save memory at some speed")
                             .choice("batch", &EmbreeOptions::batch, {"single", "packet16", "stream"},
                                     "how a batch of rays is handed over"),
                         static_cast<std::uint32_t (*)(const EmbreeOptions&)>(nullptr));
  stage.trace_peer = [](const std::any& options, const Scene& scene) -> std::shared_ptr<const Layout> {
    return std::make_shared<EmbreeLayout>(scene, std::any_cast<const EmbreeOptions&>(options));
  };
  return stage;
}

}  // namespace boxwood
#endif
