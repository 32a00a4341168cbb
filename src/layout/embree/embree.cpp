// Embree 3 (Wald, Woop, Benthin, Johnson, Ernst 2014) as a peer: its builder, its kernels, our rays. Its triangle test
// is its own, so t may differ in the last bits, and on equal distance any of the triangles may win.
#ifdef BOXWOOD_EMBREE
#include <algorithm>
#include <array>

#include "boxwood/error.h"
#include "layout/embree/embree_ray.h"
#include "layout/embree/embree_scene.h"
#include "layout/embree/embree_user.h"
#include "layout/layout.h"
#include "layout/stages.h"

namespace boxwood {
namespace {

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
                                     "how a batch of rays is handed over")
                             .choice("geometry", &EmbreeOptions::geometry, {"triangles", "user"},
                                     "Embree's triangle test, or ours by callbacks, so that only the topology differs"),
                         static_cast<std::uint32_t (*)(const EmbreeOptions&)>(nullptr));
  stage.trace_peer = [](const std::any& options, const Scene& scene) -> std::shared_ptr<const Layout> {
    const auto& embree = std::any_cast<const EmbreeOptions&>(options);
    if (embree.geometry == EmbreeGeometry::triangles) return std::make_shared<EmbreeLayout>(scene, embree);
    if (embree.batch != EmbreeBatch::single) {
      throw UsageError("'embree(geometry=user)' takes single rays only; leave out 'batch'");
    }
    return make_embree_user_layout(scene, embree);
  };
  return stage;
}

}  // namespace boxwood
#endif
