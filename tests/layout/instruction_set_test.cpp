// The same bits on every instruction set this machine has.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "support/differential.h"
#include "support/layouts.h"
#include "support/rays.h"
#include "support/scenes.h"

namespace boxwood {
namespace {

/// Pretends for its lifetime that the machine only has `targets`.
class OnlyTargets {
 public:
  explicit OnlyTargets(std::int64_t targets) { hwy::SetSupportedTargetsForTest(targets); }
  ~OnlyTargets() { hwy::SetSupportedTargetsForTest(0); }
};

TEST(EveryInstructionSet, GivesTheSameAnswers) {
  for (const test::NamedScene& named : test::troubled_scenes()) {
    const test::Expected best(named.scene, test::troubling_rays(named.scene, 200, 99));
    for (std::int64_t left = hwy::SupportedTargets() | HWY_SCALAR; left != 0; left &= left - 1) {
      const OnlyTargets only(left & -left);
      const test::Expected own(named.scene, best.rays);
      for (std::size_t i = 0; i < best.rays.size(); ++i) {
        ASSERT_TRUE(test::same_bits(own.hits[i], best.hits[i]))
            << named.name << ": " << test::describe(best.rays[i], best.hits[i], own.hits[i]);
      }
      for (const test::LayoutCall& call : {test::LayoutCall(binary_stage()), test::LayoutCall(wide_stage())}) {
        test::expect_brute_force_answers(*test::encode_scene(named.scene, call, {}), best, named.name);
      }
    }
  }
}

}  // namespace
}  // namespace boxwood
