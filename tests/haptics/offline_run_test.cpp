#include <memory>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/contact/sliding.h>
#include <glissade/contact/spring.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/grasping/grasp_simulation.h>
#include <glissade/haptics/offline_run.h>

namespace glissade::haptics {
namespace {

using devices::HapticState;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kDepth = 0.01;  // metres that the wearer wants to go into the plate

constexpr contact::CouplingStiffness kHandStiffness{1000.0, 2.0};

Isometry3d at_height(double z) {
  return Isometry3d(Eigen::Translation3d(0.0, 0.0, z));
}

std::shared_ptr<const contact::ContactBody> plate() {
  return std::make_shared<contact::ContactBody>(
      std::make_shared<geometry::TriangleMesh>(geometry::make_plate({0.5, 0.5}, 200)));
}

/// 40 mm high.
std::shared_ptr<const contact::SlidingPart> box() {
  return std::make_shared<contact::SlidingPart>(
      std::make_shared<geometry::TriangleMesh>(geometry::make_box({0.1, 0.06, 0.04}, 100)));
}

/// The hand moves down by 10 mm more than kDepth for half a second, and holds there for one.
std::vector<HapticState> press_down(grasping::GraspSimulation& sliding, std::size_t part = 0,
                                    std::chrono::nanoseconds period = kTickPeriod) {
  using std::chrono::milliseconds;
  const Isometry3d X_WH_start = sliding.parts().result(part).X_WV;
  const Isometry3d X_WH_end = at_height(X_WH_start.translation().z() - 0.01 - kDepth);
  devices::SimulatedGlove glove(geometry::PoseTrajectory(
      {{milliseconds(0), X_WH_start}, {milliseconds(500), X_WH_end}, {milliseconds(1500), X_WH_end}}));
  std::vector<HapticState> samples;
  const std::int64_t ticks = milliseconds(1500) / period;
  run_offline({{&glove, part}}, sliding, ticks, [&](const HapticState& sample) { samples.push_back(sample); },
              {.period = period});
  return samples;
}

grasping::GraspSimulation box_above_the_plate() {
  return {{{plate()}}, {{.part_V = box(), .X_WV_start = at_height(0.03), .stiffness = kHandStiffness}}};
}

/// A box is pressed on a plate.
std::vector<HapticState> press_on_plate() {
  grasping::GraspSimulation sliding = box_above_the_plate();
  return press_down(sliding);
}

/// The force (N) where two springs in a row, the wearer's arm and the coupling, share kDepth.
double force_at_rest() {
  const double arm = devices::SimulatedGloveParameters{}.wearer_stiffness;
  const double coupling = kHandStiffness.translational;
  return kDepth * arm * coupling / (arm + coupling);
}

TEST(OfflineRun, AHandPressedAgainstAPlateComesToRestWhereTheSpringsBalance) {
  const std::vector<HapticState> samples = press_on_plate();
  ASSERT_EQ(samples.size(), 1500u);
  EXPECT_NEAR(samples.back().hands[0].force_W.z(), force_at_rest(), 0.01 * force_at_rest());
  EXPECT_NEAR(samples.back().parts[0].X_WV.translation().z(), 0.02, 20e-6);
  // ... and do not swing.
  for (std::size_t i = samples.size() - 100; i < samples.size(); ++i) {
    EXPECT_NEAR(samples[i].hands[0].force_W.z(), samples.back().hands[0].force_W.z(), 1e-3);
  }
}

TEST(OfflineRun, LeadsOneOfSeveralPartsOntoAnother) {
  const auto part = box();
  grasping::GraspSimulation parts({{plate()}},
                                  {{.part_V = part, .X_WV_start = at_height(0.021), .stiffness = kHandStiffness},
                                   {.part_V = part, .X_WV_start = at_height(0.071), .stiffness = kHandStiffness}});
  const std::vector<HapticState> samples = press_down(parts, 1);
  EXPECT_NEAR(samples.back().hands[0].force_W.z(), force_at_rest(), 0.01 * force_at_rest());
  EXPECT_NEAR(samples.back().parts[1].X_WV.translation().z(), 0.061, 20e-6);
  EXPECT_EQ(parts.parts().result(0).X_WV.translation().z(), 0.021) << "nothing holds it";
}

TEST(OfflineRun, PressesThePartOnThePlateByEveryMetaphorWithoutAJump) {
  for (const contact::Metaphor metaphor :
       {contact::Metaphor::kForceFeedback, contact::Metaphor::kRubberBand, contact::Metaphor::kRubberBandSpring}) {
    SCOPED_TRACE(name_of(metaphor));
    grasping::GraspSimulation sliding(
        {{plate()}},
        {{.part_V = box(), .X_WV_start = at_height(0.03), .metaphor = metaphor, .stiffness = kHandStiffness}});
    const std::vector<HapticState> samples = press_down(sliding);
    EXPECT_NEAR(samples.back().hands[0].force_W.z(), force_at_rest(), 0.01 * force_at_rest());
    EXPECT_NEAR(samples.back().parts[0].X_WV.translation().z(), 0.02, 20e-6);
    for (std::size_t i = 1; i < samples.size(); ++i)
      ASSERT_LE((samples[i].hands[0].force_W - samples[i - 1].hands[0].force_W).norm(), 1.0) << i << " ms";
  }
}

TEST(OfflineRun, ShowsThePartWhereItIsFromTheFirstTickOn) {
  EXPECT_TRUE(press_on_plate().front().parts[0].X_WV.isApprox(Isometry3d(Eigen::Translation3d(0.0, 0.0, 0.03))));
}

TEST(OfflineRun, TheForceNeverJumps) {
  const std::vector<HapticState> samples = press_on_plate();
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double ghost_motion =
        (samples[i].parts[0].X_WG.translation() - samples[i - 1].parts[0].X_WG.translation()).norm();
    const double jump = (samples[i].hands[0].force_W - samples[i - 1].hands[0].force_W).norm();
    // The damper at most doubles what the spring does.
    EXPECT_LE(jump, 2.0 * 1000.0 * (contact::kSlew_m + ghost_motion)) << "at " << i << " ms";
  }
}

TEST(OfflineRun, TheForceDoesNotDependOnTheRate) {
  const std::vector<HapticState> usual = press_on_plate();
  for (const int microseconds : {200, 2000}) {
    grasping::GraspSimulation sliding = box_above_the_plate();
    const std::vector<HapticState> samples = press_down(sliding, 0, std::chrono::microseconds(microseconds));
    for (std::size_t ms = 2; ms < usual.size(); ms += 2) {
      const std::size_t i = ms * 1000 / static_cast<std::size_t>(microseconds) - 1;
      EXPECT_NEAR(samples[i].hands[0].force_W.z(), usual[ms - 1].hands[0].force_W.z(), 0.1) << ms << " ms";
    }
  }
  grasping::GraspSimulation sliding = box_above_the_plate();
  EXPECT_THROW(press_down(sliding, 0, std::chrono::microseconds(100)), std::invalid_argument);
}

TEST(OfflineRun, GivesTheSameBitsEveryTime) {
  const std::vector<HapticState> a = press_on_plate();
  const std::vector<HapticState> b = press_on_plate();
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].parts[0].X_WV.matrix(), b[i].parts[0].X_WV.matrix());
    ASSERT_EQ(a[i].hands[0].force_W, b[i].hands[0].force_W);
  }
}

}  // namespace
}  // namespace glissade::haptics
