#pragma once
#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "boxwood/structure.h"
#include "logic/view_state.h"
#include "tree/tree.h"

namespace boxwood::viewer {

/// One picture of one recipe, at some stage of refinement.
struct Picture {
  Image image;
  std::string recipe;
  std::uint32_t divisor = 1;  ///< pixels of the window per pixel of the image
  std::uint32_t samples = 1;  ///< per pixel; 1 goes through the centre, as `boxwood render` does
  double frame_ms = 0;        ///< of the last pass
  double mrays_per_s = 0;     ///< in the last pass, all rays, per second inside the structure and per thread
  BuildReport build;
};

/// Paints a view state in the background, coarse first: an eighth, a quarter, half of the resolution, all of it, then
/// more samples. A new state stops the pass that runs. Structures that were built are kept as long as there is room.
class Painter {
 public:
  /// One scene, or the frames of a sequence. The frames must not be empty and must outlive the painter.
  /// `samples` per pixel at most: one through its centre, then four at a time.
  Painter(const std::vector<Scene>& frames, unsigned threads, unsigned samples);
  ~Painter();
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;

  /// Starts over, unless nothing changed.
  void show(const ViewState& state);
  /// Counts up whenever something new is to be seen.
  std::uint64_t version() const;
  /// The newest pictures; the second only when comparing. Null until there is one.
  std::array<std::shared_ptr<const Picture>, 2> pictures() const;
  /// What went wrong with the state, one sentence; empty when nothing did.
  std::string trouble() const;
  /// What the painter does now: "building …", "painting", "done".
  std::string activity() const;
  /// Waits until the state is painted once at full resolution or has failed. For tests and for saving a sequence.
  void wait_for_full_picture() const;
  /// The structure and the tree behind a picture, to look into; null for a recipe that failed. Trees of peers and of
  /// scenes on two levels are empty.
  struct Built {
    Structure structure;
    std::shared_ptr<const Tree> tree;
  };
  std::shared_ptr<const Built> built(int side) const;

 private:
  class Stop;
  void work();
  void paint(const ViewState& state, Stop& stop);
  std::shared_ptr<const Built> structure_of(std::size_t frame, const std::string& recipe);
  void publish(int side, std::shared_ptr<const Picture> picture);
  void set_activity(const std::string& text);

  const std::vector<Scene>& frames_;
  const unsigned threads_, samples_;

  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  ViewState wanted_;
  bool wanted_set_ = false, fresh_ = false, closing_ = false, full_ = false;
  std::atomic<bool> stop_{false};
  std::uint64_t version_ = 0;
  std::array<std::shared_ptr<const Picture>, 2> pictures_;
  std::array<std::shared_ptr<const Built>, 2> built_;
  std::string trouble_, activity_ = "starting";

  std::map<std::pair<std::size_t, std::string>, std::shared_ptr<const Built>> structures_;  // the worker's alone
  std::thread worker_;
};

}  // namespace boxwood::viewer
