#include "moving/part_accounts.h"

#include <algorithm>
#include <numeric>

namespace boxwood {
namespace {

double ratio(double cost, double area) { return area > 0 ? cost / area : 0; }

}  // namespace

void PartAccounts::start(const PartCosts& costs, const std::vector<double>& areas,
                         const std::vector<std::uint32_t>& references) {
  cost_ = ratio(std::accumulate(costs.begin(), costs.end(), 0.0), areas.back());
  whole_ = {cost_, 0, 0, std::accumulate(references.begin(), references.end(), 0.0)};
  accounts_.assign(costs.size(), {});
  for (std::size_t p = 0; p < costs.size(); ++p) {
    accounts_[p].expected = ratio(costs[p], areas[p]);
    accounts_[p].price = p < references.size() ? references[p] : static_cast<double>(references.size());
  }
}

void PartAccounts::charge(const PartCosts& costs, const std::vector<double>& areas, const MotionPolicy& policy) {
  const double root_area = areas.back();
  cost_ = ratio(std::accumulate(costs.begin(), costs.end(), 0.0), root_area);
  const auto charge = [&](Account& account, double excess) {
    account.excess = std::max(excess, 0.0);
    account.owed += policy.rays_per_update * account.excess;
  };
  charge(whole_, cost_ - whole_.expected);
  for (std::size_t p = 0; p < accounts_.size(); ++p) {
    charge(accounts_[p], ratio(costs[p] - accounts_[p].expected * areas[p], root_area));
  }
}

DueParts PartAccounts::due(const MotionPolicy& policy) const {
  const auto is_due = [&](const Account& account) {
    return account.excess > 0 && account.owed >= policy.build_price * account.price;
  };
  DueParts out;
  double references = 0;
  for (std::uint32_t p = 0; p + 1 < accounts_.size(); ++p) {
    if (!is_due(accounts_[p])) continue;
    out.parts.push_back(p);
    references += accounts_[p].price;
  }
  out.above = is_due(accounts_.back());
  // Where half of it is due, one build of everything makes the better tree.
  out.all = is_due(whole_) || (references > 0 && 2 * references >= whole_.price);
  return out;
}

DueParts PartAccounts::worst(double share) const {
  DueParts out;
  out.above = true;
  std::vector<std::uint32_t> by_excess(accounts_.size() - 1);
  std::iota(by_excess.begin(), by_excess.end(), 0u);
  std::ranges::stable_sort(by_excess, std::greater<>(), [&](std::uint32_t p) { return accounts_[p].excess; });
  double references = 0;
  for (const std::uint32_t p : by_excess) {
    if (references >= share * whole_.price || !(accounts_[p].excess > 0)) break;
    out.parts.push_back(p);
    references += accounts_[p].price;
  }
  std::ranges::sort(out.parts);
  return out;
}

void PartAccounts::settle(const DueParts& built, const PartCosts& costs, const std::vector<double>& areas) {
  const auto start_anew = [&](std::size_t p) { accounts_[p] = {ratio(costs[p], areas[p]), 0, 0, accounts_[p].price}; };
  for (const std::uint32_t p : built.parts) start_anew(p);
  if (built.above) start_anew(accounts_.size() - 1);
  cost_ = ratio(std::accumulate(costs.begin(), costs.end(), 0.0), areas.back());
}

}  // namespace boxwood
