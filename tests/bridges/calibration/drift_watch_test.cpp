/// Sensors that drift or slip, and hands that only do something else.

#include <chrono>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/bridges/drift_watch.h>

namespace glissade::bridges {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::size_t kDriftingPip = 5;
constexpr std::size_t kSteadyPip = 8;

/// All sentences over ten minutes of a hand whose fingers close every two seconds. The angle of the index after
/// calibration is what `shown` makes of the true angle (rad) at a time in minutes.
std::vector<std::string> said_of(const std::function<double(double minutes, double angle)>& shown) {
  devices::Calibration calibration;
  calibration.joints[kDriftingPip] = calibration.joints[kSteadyPip] =
      devices::JointCalibration{.gain = 2.0, .offset = 0.1, .reported_least = -0.05, .reported_most = 0.75};
  DriftWatch watch(calibration);
  std::vector<std::string> sentences;
  for (std::int64_t i = 0; i < 600 * 20; ++i) {
    devices::GloveState state;
    state.sequence = i;
    state.time = i * std::chrono::milliseconds(50);
    const double minutes = static_cast<double>(i) / 1200.0;
    const double angle = 0.6 * (1.0 - std::cos(M_PI * 60.0 * minutes));
    state.joint_angles[kDriftingPip] = calibration.joints[kDriftingPip]->reported(shown(minutes, angle));
    state.joint_angles[kSteadyPip] = calibration.joints[kSteadyPip]->reported(angle);
    if (const auto sentence = watch.note(state)) sentences.push_back(*sentence);
  }
  return sentences;
}

TEST(DriftWatch, IsSilentWhileASensorIsRight) {
  EXPECT_THAT(said_of([](double, double angle) { return angle; }), IsEmpty());
}

TEST(DriftWatch, SaysOnceThatASensorDrifts) {
  const auto sentences = said_of([](double minutes, double angle) { return angle + 0.05 * minutes; });
  EXPECT_THAT(sentences, ElementsAre(AllOf(HasSubstr("index_pip has drifted by 1"), HasSubstr("calibrate again"))));
}

TEST(DriftWatch, SaysOnceThatASensorLeavesItsRange) {
  const auto sentences = said_of([](double minutes, double angle) { return minutes < 0.5 ? angle : angle + 1.5; });
  EXPECT_THAT(sentences, ElementsAre(HasSubstr("index_pip leaves its calibrated range by")));
}

TEST(DriftWatch, DoesNotMindWildReadings) {
  int i = 0;
  EXPECT_THAT(said_of([&](double, double angle) { return ++i % 50 == 0 ? 3.0 : angle; }), IsEmpty());
}

TEST(DriftWatch, DoesNotMindAHandThatClosesLess) {
  EXPECT_THAT(said_of([](double minutes, double angle) { return minutes < 3.0 ? angle : 0.6 * angle; }), IsEmpty());
}

}  // namespace
}  // namespace glissade::bridges
