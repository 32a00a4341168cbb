// More than one hit of a ray, from any layout: its kernels bring all they find, in whatever order; here they are put in
// order and made unique. So the answers depend on the triangles only, as those of closest_hit do.
#include "query/hit_queries.h"

#include <algorithm>
#include <array>
#include <limits>

namespace boxwood {
namespace {

class AllHits final : public HitSink {
 public:
  explicit AllHits(std::vector<Hit>& hits) : HitSink(std::numeric_limits<float>::infinity()), hits_(hits) {}
  void offer(const Hit& hit) override { hits_.push_back(hit); }

 private:
  std::vector<Hit>& hits_;
};

/// Keeps the first hits behind `after`, in order. The walk is cut off at the last of them.
class FirstHits final : public HitSink {
 public:
  FirstHits(std::span<Hit> hits, const Hit* after)
      : HitSink(std::numeric_limits<float>::infinity()), hits_(hits), after_(after) {}

  void offer(const Hit& hit) override {
    if (after_ && !comes_before(*after_, hit)) return;
    Hit* const end = hits_.data() + size_;
    Hit* const place = std::lower_bound(hits_.data(), end, hit, comes_before);
    if (place != end && !comes_before(hit, *place)) return;  // found before, in another leaf
    if (place == hits_.data() + hits_.size()) return;
    if (size_ < hits_.size()) ++size_;
    std::move_backward(place, hits_.data() + size_ - 1, hits_.data() + size_);
    *place = hit;
    if (size_ == hits_.size()) lower_cutoff(hits_.back().t);
  }
  std::size_t size() const { return size_; }

 private:
  std::span<Hit> hits_;
  const Hit* after_;
  std::size_t size_ = 0;
};

}  // namespace

void append_all_hits(const Layout& layout, const Ray& ray, std::uint32_t mask, std::vector<Hit>& hits) {
  if (mask == 0) return;
  const auto old_size = static_cast<std::ptrdiff_t>(hits.size());
  AllHits sink(hits);
  layout.offer_hits(ray, {0, mask}, sink);
  std::sort(hits.begin() + old_size, hits.end(), comes_before);
  hits.erase(std::unique(hits.begin() + old_size, hits.end()), hits.end());
}

std::size_t first_hits(const Layout& layout, const Ray& ray, std::uint32_t mask, std::span<Hit> hits) {
  if (hits.empty() || mask == 0) return 0;
  FirstHits sink(hits, nullptr);
  layout.offer_hits(ray, {0, mask}, sink);
  return sink.size();
}

Hit first_accepted(const Layout& layout, const Ray& ray, std::uint32_t mask, std::size_t number, const Hit& first,
                   HitFilter accept) {
  if (!first.valid() || accept(number, first)) return first;
  std::array<Hit, 32> memory;
  Hit last = first;
  // Few at first: most rays are stopped soon.
  for (std::size_t most = 4;; most = std::min(2 * most, memory.size())) {
    Ray rest = ray;
    rest.t_near = last.t;
    FirstHits sink({memory.data(), most}, &last);
    layout.offer_hits(rest, {0, mask}, sink);
    for (std::size_t i = 0; i < sink.size(); ++i) {
      if (accept(number, memory[i])) return memory[i];
    }
    if (sink.size() < most) return {};
    last = memory[most - 1];
  }
}

}  // namespace boxwood
