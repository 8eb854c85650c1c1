// Where a held primitive comes to rest, against the physics of ODE (ode_reference.h), whose obstacles are moved by the
// margin. ode_comparison.cpp prints the figures.

#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "ode_scenes.h"

namespace glissade::contact {
namespace {

using test_support::OdeComparison;
using test_support::OdeScene;

class AgainstOde : public ::testing::TestWithParam<OdeScene> {};

TEST_P(AgainstOde, ThePartRestsInTheSamePlaceUnderTheSameForce) {
  const OdeScene& scene = GetParam();
  SCOPED_TRACE(scene.name);
  const OdeComparison comparison = test_support::compare_with_ode(scene);
  ASSERT_TRUE(comparison.at_rest);
  EXPECT_GT(comparison.contacts, 0);
  EXPECT_LT(comparison.ode_imbalance, 1e-5) << "ODE has not settled";
  EXPECT_LE(comparison.difference.v.norm(), 1e-6 + scene.sagitta);
  if (scene.sagitta > 0.0) return;  // a smooth sphere rolls where a faceted one tips
  EXPECT_LE(comparison.difference.w.norm(), 1e-3 * std::numbers::pi / 180.0);
  EXPECT_LE(comparison.force_difference, 1e-3);
  EXPECT_LE(comparison.wrench_difference, 1e-3);
}

/// "on a block" as OnABlock.
std::string name_of_case(const ::testing::TestParamInfo<OdeScene>& scene) {
  std::string name;
  bool capital = true;
  for (const char c : scene.param.name) {
    const bool letter = c >= 'a' && c <= 'z';
    if (letter) name += capital ? static_cast<char>(c - 'a' + 'A') : c;
    capital = !letter;
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Scenes, AgainstOde, ::testing::ValuesIn(test_support::ode_scenes()), name_of_case);

}  // namespace
}  // namespace glissade::contact
