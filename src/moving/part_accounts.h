#pragma once
#include <cstdint>
#include <vector>

#include "boxwood/moving.h"
#include "tree/parts.h"

namespace boxwood {

/// What is to be built anew.
struct DueParts {
  bool all = false;
  bool above = false;                ///< the nodes above the parts
  std::vector<std::uint32_t> parts;  ///< ascending
};

/// Keeps the books of a tree that is refitted: what refitting has cost so far, part by part, against what a rebuild
/// would cost. The old rule for renting or buying: buy when the rents paid reach the price, and you never pay more than
/// twice what you would have, had you known the future.
class PartAccounts {
 public:
  /// After a build: costs and areas of the parts, then of what lies above (the whole tree's area).
  void start(const PartCosts& costs, const std::vector<double>& areas, const std::vector<std::uint32_t>& references);
  /// After a refit, before the rays that are traced next.
  void charge(const PartCosts& costs, const std::vector<double>& areas, const MotionPolicy& policy);
  /// Never everything that was just built.
  DueParts due(const MotionPolicy& policy) const;
  /// The parts where the expected cost is exceeded most, with `share` of all references, and what lies above.
  DueParts worst(double share) const;
  /// Some were built anew and now cost this.
  void settle(const DueParts& built, const PartCosts& costs, const std::vector<double>& areas);

  double cost() const { return cost_; }
  double cost_when_built() const { return whole_.expected; }

 private:
  struct Account {
    double expected = 0;  ///< cost per area when built
    double excess = 0;    ///< cost beyond that, now
    double owed = 0;      ///< what that has cost all rays so far
    double price = 0;     ///< of building it, without the policy's factor
  };
  Account whole_;
  std::vector<Account> accounts_;  ///< of the parts, then of what lies above
  double cost_ = 0;                ///< of the whole tree
};

}  // namespace boxwood
