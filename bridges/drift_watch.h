#pragma once

/// Notices sensors that no longer fit their calibration, because the glove has slipped or a sensor drifts.

#include <array>
#include <chrono>
#include <optional>
#include <string>

#include <glissade/devices/calibration.h>
#include <glissade/devices/glove_device.h>

namespace glissade::bridges {

/// Examines the angles minute by minute. A joint leaves its range if its angle is far outside both the calibrated range
/// and the range of a human joint for a tenth of a minute or longer. A joint drifts if both ends of its range have
/// moved to the same side since the first minute in which the joint moved. So other motions of the hand are no drift.
class DriftWatch {
 public:
  explicit DriftWatch(devices::Calibration calibration) : calibration_(std::move(calibration)) {}

  /// Notes a state as the device reports it. Returns a sentence at the end of a minute in which joints began to leave
  /// their range or to drift. Names each joint once.
  std::optional<std::string> note(const devices::GloveState& reported);

 private:
  struct Range {
    double least;
    double most;
  };
  struct Joint {
    std::optional<Range> minute;  ///< of this minute, rad of the hand
    std::optional<Range> first;   ///< of the first minute in which the joint moved
    int states_outside = 0;
    double farthest_outside = 0.0;
    bool is_told = false;
  };

  void note(std::size_t joint, double angle);
  std::string end_of_minute();
  std::string words_for(std::size_t joint);

  devices::Calibration calibration_;
  std::array<Joint, hands::kJoints> joints_{};
  int states_ = 0;  ///< of this minute
  std::optional<std::chrono::nanoseconds> begin_;
};

}  // namespace glissade::bridges
