#include "logic/painter.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "boxwood/error.h"
#include "measure/clock.h"
#include "render/progress.h"
#include "structure/pipeline.h"

namespace boxwood::viewer {
namespace {

constexpr std::size_t most_structures = 16;  // kept for switching back

std::shared_ptr<const Tree> visible_tree(const Scene& scene, const Recipe& recipe) {
  const bool peer =
      std::ranges::any_of(recipe.stages(), [](const StageCall& c) { return c.stage->kind == StageKind::peer; });
  if (peer || !scene.single_level()) return std::make_shared<Tree>();
  return std::make_shared<Tree>(tree_of(scene.meshes[0], recipe));
}

double mrays_per_s(const RenderResult& result) {
  double rays = 0, seconds = 0;
  for (const RayKindReport& report : result.ray_kinds) {
    rays += static_cast<double>(report.rays);
    seconds += report.trace_seconds;
  }
  return seconds > 0 ? rays / seconds / 1e6 : 0;
}

/// `mean` of `samples` with `more` of `count` added.
void accumulate(Image& mean, std::uint32_t samples, const Image& more, std::uint32_t count) {
  const float total = static_cast<float>(samples + count);
  const float old_share = static_cast<float>(samples) / total, new_share = static_cast<float>(count) / total;
  for (std::size_t i = 0; i < mean.pixels.size(); ++i) {
    mean.pixels[i] = mean.pixels[i] * old_share + more.pixels[i] * new_share;
  }
}

}  // namespace

class Painter::Stop final : public ProgressSink {
 public:
  explicit Stop(const std::atomic<bool>& stop) : stop_(stop) {}
  bool report(double, std::string_view) override { return !stop_; }
  void check() const {
    if (stop_) throw Cancelled();
  }

 private:
  const std::atomic<bool>& stop_;
};

Painter::Painter(const std::vector<Scene>& frames, unsigned threads, unsigned samples)
    : frames_(frames), threads_(threads), samples_(samples), worker_([this] { work(); }) {}

Painter::~Painter() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
    stop_ = true;
  }
  changed_.notify_all();
  worker_.join();
}

void Painter::show(const ViewState& state) {
  {
    const std::lock_guard lock(mutex_);
    if (wanted_set_ && state == wanted_) return;
    wanted_ = state;
    wanted_set_ = fresh_ = true;
    full_ = false;
    stop_ = true;
    activity_ = "painting";
  }
  changed_.notify_all();
}

std::uint64_t Painter::version() const {
  const std::lock_guard lock(mutex_);
  return version_;
}

std::array<std::shared_ptr<const Picture>, 2> Painter::pictures() const {
  const std::lock_guard lock(mutex_);
  return pictures_;
}

std::string Painter::trouble() const {
  const std::lock_guard lock(mutex_);
  return trouble_;
}

std::string Painter::activity() const {
  const std::lock_guard lock(mutex_);
  return activity_;
}

std::shared_ptr<const Painter::Built> Painter::built(int side) const {
  const std::lock_guard lock(mutex_);
  return built_[static_cast<std::size_t>(side)];
}

void Painter::wait_for_full_picture() const {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return full_ || (!fresh_ && !trouble_.empty()); });
}

void Painter::work() {
  tbb::task_arena arena(threads_ == 0 ? tbb::task_arena::automatic : static_cast<int>(threads_));
  while (true) {
    ViewState state;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return fresh_ || closing_; });
      if (closing_) return;
      state = wanted_;
      fresh_ = false;
      stop_ = false;
      trouble_.clear();
    }
    Stop stop(stop_);
    std::string trouble;
    try {
      arena.execute([&] { paint(state, stop); });
    } catch (const Cancelled&) {
      continue;
    } catch (const std::exception& error) {
      trouble = error.what();
    }
    const std::lock_guard lock(mutex_);
    if (fresh_) continue;
    trouble_ = trouble;
    activity_ = trouble.empty() ? "done" : "stopped";
    ++version_;
    changed_.notify_all();
  }
}

std::shared_ptr<const Painter::Built> Painter::structure_of(std::size_t frame, const std::string& text) {
  const auto key = std::pair(frame, text);
  if (const auto found = structures_.find(key); found != structures_.end()) return found->second;
  set_activity(fmt::format("building {}", text));
  if (structures_.size() >= most_structures) structures_.clear();
  const Recipe recipe = Recipe::parse(text);
  const Scene& scene = frames_[frame];
  auto built =
      std::make_shared<const Built>(Built{build(scene, recipe, {.threads = threads_}), visible_tree(scene, recipe)});
  structures_.emplace(key, built);
  return built;
}

void Painter::paint(const ViewState& state, Stop& stop) {
  const int sides = state.compare ? 2 : 1;
  const std::size_t frame = std::min(state.frame, frames_.size() - 1);
  std::array<std::shared_ptr<const Built>, 2> built;
  for (int side = 0; side < sides; ++side) {
    const std::string recipe = with_order(state.recipes[static_cast<std::size_t>(side)], state.order);
    built[static_cast<std::size_t>(side)] = structure_of(frame, recipe);
    stop.check();
  }
  {
    const std::lock_guard lock(mutex_);
    built_ = built;
    if (sides == 1) pictures_[1].reset();
  }
  set_activity("painting");
  const auto pass = [&](int side, std::uint32_t divisor, std::uint32_t spp, std::uint64_t seed) {
    const Built& b = *built[static_cast<std::size_t>(side)];
    RenderSettings settings = state.settings;
    settings.width = std::max(1u, settings.width / divisor);
    settings.height = std::max(1u, settings.height / divisor);
    settings.spp = spp;
    settings.seed = seed;
    const double begin = now(Clock::wall);
    RenderResult result = render(frames_[frame], b.structure, settings, &stop);
    auto picture = std::make_shared<Picture>();
    picture->frame_ms = (now(Clock::wall) - begin) * 1000;
    picture->mrays_per_s = mrays_per_s(result);
    picture->image = std::move(result.image);
    picture->recipe = b.structure.recipe().text();
    picture->divisor = divisor;
    picture->samples = spp;
    picture->build = b.structure.report();
    return picture;
  };
  for (const std::uint32_t divisor : {8u, 4u, 2u, 1u}) {
    for (int side = 0; side < sides; ++side) publish(side, pass(side, divisor, 1, 1));
  }
  {
    const std::lock_guard lock(mutex_);
    if (!fresh_) full_ = true;
  }
  changed_.notify_all();
  for (std::uint32_t samples = 1; samples + 4 <= samples_; samples += 4) {
    for (int side = 0; side < sides; ++side) {
      const std::shared_ptr<Picture> more = pass(side, 1, 4, samples + 1);
      Image mean = pictures()[static_cast<std::size_t>(side)]->image;
      accumulate(mean, samples, more->image, 4);
      more->image = std::move(mean);
      more->samples = samples + 4;
      publish(side, more);
    }
  }
}

void Painter::publish(int side, std::shared_ptr<const Picture> picture) {
  const std::lock_guard lock(mutex_);
  pictures_[static_cast<std::size_t>(side)] = std::move(picture);
  ++version_;
}

void Painter::set_activity(const std::string& text) {
  const std::lock_guard lock(mutex_);
  activity_ = text;
  ++version_;
}

}  // namespace boxwood::viewer
