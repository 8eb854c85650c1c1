/// A hand that was lost does not set what the other holders of its part feel.

#include <algorithm>
#include <array>
#include <chrono>
#include <numbers>

#include <gtest/gtest.h>

#include <glissade/devices/simulated_glove.h>
#include <glissade/haptics/haptic_kernel.h>

namespace glissade::haptics {
namespace {

using std::chrono::milliseconds;

/// Three hands hold a part. The first one sends no states after 0.5 s. The others, one degree apart, turn the part by
/// half a turn from there, so their rotations from the lost hand are opposite.
TEST(LostHolder, HalfATurnAwayFromTheOthersIsNotFelt) {
  const devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  const contact::CouplingStiffness stiffness{1000.0, 1.0};
  HapticKernel kernel({{Eigen::Vector3d::Zero(), 0.05, stiffness}}, {{device, 0}, {device, 0}, {device, 0}});
  ContactSet set;
  std::array<devices::GloveState, 3> states;
  double greatest_Nm = 0.0;
  for (int ms = 1; ms <= 6000; ++ms) {
    const double turn = std::clamp((ms - 1000) / 4000.0, 0.0, 1.0) * std::numbers::pi;
    for (std::size_t h = ms <= 500 ? 0 : 1; h < states.size(); ++h) {
      const double apart = turn / 180.0 * (static_cast<double>(h) - 1.5);
      const Eigen::AngleAxisd rotation(turn + (h == 0 ? 0.0 : apart), Eigen::Vector3d::UnitZ());
      states[h].X_WH = Eigen::Isometry3d(rotation);
      states[h].w_WH.z() = turn > 0.0 && turn < std::numbers::pi ? std::numbers::pi / 4.0 : 0.0;
      states[h].sequence = ms;
      states[h].time = milliseconds(ms);
    }
    set.sequence = ms;
    set.time = milliseconds(ms);
    const HapticTick tick = kernel.tick(std::array<const devices::GloveState*, 3>{&states[0], &states[1], &states[2]},
                                        set, milliseconds(ms));
    set.parts[0].hold = tick.ghosts.parts[0].hold;
    for (std::size_t h = 1; h < states.size(); ++h)
      greatest_Nm = std::max(greatest_Nm, tick.hands[h].command.values().t_H_W.norm());
  }
  EXPECT_GT(greatest_Nm, 0.0) << "of the degree between them";
  EXPECT_LT(greatest_Nm, 0.02);
}

}  // namespace
}  // namespace glissade::haptics
