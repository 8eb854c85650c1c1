#include <algorithm>
#include <cmath>

#include <glissade/bridges/drift_watch.h>

#include "calibration/degrees.h"

namespace glissade::bridges {
namespace {

constexpr std::chrono::minutes kMinute{1};
/// Chosen: at this error, a fingertip is off by a finger's breadth. Poses of one wearer differ by less.
constexpr double kNoticed_rad = radians(10.0);
constexpr double kMoved_rad = radians(30.0);  // of a joint that has moved
constexpr int kShareOutside = 10;             // one state in so many

}  // namespace

std::optional<std::string> DriftWatch::note(const devices::GloveState& reported) {
  if (!begin_) begin_ = reported.time;
  std::optional<std::string> sentence;
  if (reported.time - *begin_ >= kMinute) {
    const std::string words = end_of_minute();
    if (!words.empty()) sentence = words + ": the glove has slipped or a sensor drifts; calibrate again";
    begin_ = reported.time;
  }
  ++states_;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const std::optional<devices::JointCalibration>& joint = calibration_.joints[j];
    if (joint && std::isfinite(reported.joint_angles[j])) note(j, joint->angle(reported.joint_angles[j]));
  }
  return sentence;
}

void DriftWatch::note(std::size_t joint, double angle) {
  Joint& seen = joints_[joint];
  if (!seen.minute) seen.minute = Range{angle, angle};
  seen.minute->least = std::min(seen.minute->least, angle);
  seen.minute->most = std::max(seen.minute->most, angle);

  const devices::JointCalibration& calibrated = *calibration_.joints[joint];
  const hands::JointRange& human = hands::kJointRanges[joint];
  const double lower = std::min(calibrated.angle(calibrated.reported_least), radians(human.lower_deg));
  const double upper = std::max(calibrated.angle(calibrated.reported_most), radians(human.upper_deg));
  const double outside = std::max(lower - angle, angle - upper);
  if (outside <= kNoticed_rad) return;
  ++seen.states_outside;
  seen.farthest_outside = std::max(seen.farthest_outside, outside);
}

std::string DriftWatch::end_of_minute() {
  std::string all;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    Joint& joint = joints_[j];
    const std::string words = joint.minute && !joint.is_told ? words_for(j) : std::string();
    joint.is_told = joint.is_told || !words.empty();
    if (!words.empty()) all += (all.empty() ? "" : ", ") + words;
    joint.minute.reset();
    joint.states_outside = 0;
    joint.farthest_outside = 0.0;
  }
  states_ = 0;
  return all;
}

std::string DriftWatch::words_for(std::size_t joint) {
  Joint& seen = joints_[joint];
  const std::string name(hands::kJointNames[joint]);
  if (kShareOutside * seen.states_outside >= states_)
    return name + " leaves its calibrated range by " + degrees_text(seen.farthest_outside);
  if (seen.minute->most - seen.minute->least < kMoved_rad) return {};
  if (!seen.first) seen.first = seen.minute;
  const double lower = seen.minute->least - seen.first->least;
  const double upper = seen.minute->most - seen.first->most;
  const double moved = std::min(std::abs(lower), std::abs(upper));
  if (lower * upper <= 0.0 || moved < kNoticed_rad) return {};
  return name + " has drifted by " + degrees_text(moved);
}

}  // namespace glissade::bridges
