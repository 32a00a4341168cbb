#include "structure/instance_paths.h"

#include <algorithm>

#include "structure/size_limits.h"

namespace boxwood {

InstancePaths::InstancePaths(std::uint32_t instances) : numbers_(instances) {}

InstancePaths::InstancePaths(std::vector<std::shared_ptr<const InstancePaths>> parts) : parts_(std::move(parts)) {
  std::uint64_t numbers = 0;
  first_.reserve(parts_.size());
  for (const auto& part : parts_) {
    first_.push_back(static_cast<std::uint32_t>(numbers));
    numbers += part ? part->numbers() : 1;
    check_named(0, numbers);
    if (part) levels_ = std::max(levels_, part->levels() + 1);
  }
  numbers_ = static_cast<std::uint32_t>(numbers);
}

void InstancePaths::append_path(std::uint32_t instance, std::vector<std::uint32_t>& path) const {
  if (parts_.empty()) {
    path.push_back(instance);
    return;
  }
  // The last that begins at or before it; those without numbers begin where the next one does.
  const auto after = std::upper_bound(first_.begin(), first_.end(), instance);
  const auto place = static_cast<std::size_t>(after - first_.begin()) - 1;
  path.push_back(static_cast<std::uint32_t>(place));
  if (parts_[place]) parts_[place]->append_path(instance - first_[place], path);
}

}  // namespace boxwood
