#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/haptics/offline_run.h>
#include <glissade/haptics/sliding.h>

namespace glissade::haptics {
namespace {

using devices::HapticState;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kDepth = 0.01;  // metres that the wearer wants to go into the plate

/// A box is pressed on a plate: down for half a second, then held for one.
std::vector<HapticState> press_on_plate() {
  using std::chrono::milliseconds;
  const auto plate =
      std::make_shared<ContactBody>(std::make_shared<geometry::TriangleMesh>(geometry::make_plate({0.5, 0.5}, 200)));
  const auto box = std::make_shared<SlidingPart>(
      std::make_shared<geometry::TriangleMesh>(geometry::make_box({0.1, 0.06, 0.04}, 100)));
  const Isometry3d X_WV_start(Eigen::Translation3d(0.0, 0.0, 0.03));
  const Isometry3d X_WH_end(Eigen::Translation3d(0.0, 0.0, 0.02 - kDepth));
  devices::SimulatedGlove glove(geometry::PoseTrajectory(
      {{milliseconds(0), X_WV_start}, {milliseconds(500), X_WH_end}, {milliseconds(1500), X_WH_end}}));
  const Coupling coupling = coupling_for(glove.descriptor(), {1000.0, 2.0});
  Sliding sliding({{plate}}, box, X_WV_start, {.stiffness = coupling.stiffness});
  std::vector<HapticState> samples;
  run_offline(glove, sliding, 1500, [&](const HapticState& sample) { samples.push_back(sample); });
  return samples;
}

TEST(OfflineRun, AHandPressedAgainstAPlateComesToRestWhereTheSpringsBalance) {
  const std::vector<HapticState> samples = press_on_plate();
  ASSERT_EQ(samples.size(), 1500u);
  // Two springs in a row, the wearer's arm and the coupling, share the depth.
  const double arm = devices::SimulatedGloveParameters{}.wearer_stiffness;
  const double force = kDepth * arm * 1000.0 / (arm + 1000.0);
  EXPECT_NEAR(samples.back().force_on_hand_W.z(), force, 0.01 * force);
  EXPECT_NEAR(samples.back().X_WV.translation().z(), 0.02, 20e-6);
  // ... and do not swing.
  for (std::size_t i = samples.size() - 100; i < samples.size(); ++i) {
    EXPECT_NEAR(samples[i].force_on_hand_W.z(), samples.back().force_on_hand_W.z(), 1e-3);
  }
}

TEST(OfflineRun, ShowsThePartWhereItIsFromTheFirstTickOn) {
  EXPECT_TRUE(press_on_plate().front().X_WV.isApprox(Isometry3d(Eigen::Translation3d(0.0, 0.0, 0.03))));
}

TEST(OfflineRun, TheForceNeverJumps) {
  const std::vector<HapticState> samples = press_on_plate();
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double ghost_motion = (samples[i].X_WG.translation() - samples[i - 1].X_WG.translation()).norm();
    const double jump = (samples[i].force_on_hand_W - samples[i - 1].force_on_hand_W).norm();
    // The damper at most doubles what the spring does.
    EXPECT_LE(jump, 2.0 * 1000.0 * (kSlew_m + ghost_motion)) << "at " << i << " ms";
  }
}

TEST(OfflineRun, GivesTheSameBitsEveryTime) {
  const std::vector<HapticState> a = press_on_plate();
  const std::vector<HapticState> b = press_on_plate();
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].X_WV.matrix(), b[i].X_WV.matrix());
    ASSERT_EQ(a[i].force_on_hand_W, b[i].force_on_hand_W);
  }
}

}  // namespace
}  // namespace glissade::haptics
