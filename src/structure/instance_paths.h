#pragma once
#include <cstdint>
#include <memory>
#include <vector>

namespace boxwood {

/// How the numbers of instances come about in a structure with levels of instances.
class InstancePaths {
 public:
  /// Of a scene: `instances` of them, one number each.
  explicit InstancePaths(std::uint32_t instances);
  /// Of instances placed in turn: `parts[i]` is what instance i places, null for one mesh. Throws Error when numbers
  /// run out.
  explicit InstancePaths(std::vector<std::shared_ptr<const InstancePaths>> parts);

  /// Levels of instances.
  std::uint32_t levels() const { return levels_; }
  std::uint32_t numbers() const { return numbers_; }
  /// Of each instance that was placed, its first number; empty for a scene's.
  const std::vector<std::uint32_t>& first_numbers() const { return first_; }
  /// Appends the way to number `instance` < numbers().
  void append_path(std::uint32_t instance, std::vector<std::uint32_t>& path) const;

 private:
  std::uint32_t levels_ = 1, numbers_ = 0;
  std::vector<std::uint32_t> first_;
  std::vector<std::shared_ptr<const InstancePaths>> parts_;
};

}  // namespace boxwood
