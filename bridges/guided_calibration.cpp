#include <algorithm>
#include <cmath>
#include <utility>

#include <glissade/bridges/calibration_poses.h>
#include <glissade/bridges/guided_calibration.h>

namespace glissade::bridges {
namespace {

using std::chrono::nanoseconds;

constexpr std::chrono::milliseconds kPoll{2};

nanoseconds rounded(std::chrono::duration<double> time) {
  return std::chrono::duration_cast<nanoseconds>(time);
}

/// The wearer ended the calibration.
struct Ended {};

class Guide {
 public:
  Guide(devices::GloveDevice& glove, const devices::GloveInfo& info, const GuidedCalibrationOptions& options,
        realtime::Clock& clock, const std::function<bool()>& goes_on, const CalibrationVoice& voice)
      : glove_(glove), info_(info), options_(options), clock_(clock), goes_on_(goes_on), voice_(voice) {}

  GuidedCalibration calibrate() {
    std::array<HeldPose, kCalibrationPoses> poses;
    for (std::size_t p = 0; p < poses.size(); ++p)
      poses[p] = shown(p);
    JointFits fits = fit_joints(poses, options_.without);
    GuidedCalibration result{
        .calibration = {.device = info_.descriptor.name, .side = info_.side, .joints = fits.joints},
        .remarks = std::move(fits.remarks)};
    constexpr std::size_t kFlat = 0;
    if (options_.X_WH_flat) result.calibration.X_TH = poses[kFlat].X_WT.inverse() * *options_.X_WH_flat;
    return result;
  }

 private:
  HeldPose shown(std::size_t p) {
    const CalibrationPose& pose = calibration_poses()[p];
    const std::string number = std::to_string(p + 1) + " of " + std::to_string(kCalibrationPoses);
    voice_.say("pose " + number + ", " + std::string(pose.name) + ": " + std::string(pose.guidance));
    for (int tries = 1;; ++tries) {
      count_down(options_.pause, "take the pose: ");
      try {
        return held_pose(states_of_hold(), info_.descriptor);
      } catch (const CalibrationError& error) {
        if (tries == options_.tries)
          throw CalibrationError("the pose '" + std::string(pose.name) + "' failed " + std::to_string(tries) +
                                 " times: " + error.what());
        voice_.say(std::string(error.what()) + "; once more");
      }
    }
  }

  void count_down(std::chrono::duration<double> time, const std::string& what) {
    const nanoseconds end = clock_.now() + rounded(time);
    for (nanoseconds now = clock_.now(); now < end; now = clock_.now()) {
      if (!goes_on_()) throw Ended{};
      voice_.show(what + std::to_string(static_cast<int>(std::ceil(std::chrono::duration<double>(end - now).count()))));
      clock_.sleep_until(std::min(end, now + std::chrono::milliseconds(100)));
    }
  }

  std::vector<devices::GloveState> states_of_hold() {
    voice_.show("hold still");
    std::vector<devices::GloveState> states;
    devices::GloveState newest;
    glove_.read(newest);
    const nanoseconds end = clock_.now() + rounded(options_.hold);
    for (nanoseconds now = clock_.now(); now < end; now = clock_.now()) {
      if (!goes_on_()) throw Ended{};
      const std::int64_t before = newest.sequence;
      if (glove_.read(newest) && newest.sequence != before) states.push_back(newest);
      if (newest.obeys_another)
        throw CalibrationError("a server commands the glove, and may stop its fingers: end the server first");
      clock_.sleep_until(now + kPoll);
    }
    return states;
  }

  devices::GloveDevice& glove_;
  const devices::GloveInfo& info_;
  const GuidedCalibrationOptions& options_;
  realtime::Clock& clock_;
  const std::function<bool()>& goes_on_;
  const CalibrationVoice& voice_;
};

}  // namespace

std::optional<GuidedCalibration> guide_calibration(devices::GloveDevice& glove, const devices::GloveInfo& info,
                                                   const GuidedCalibrationOptions& options, realtime::Clock& clock,
                                                   const std::function<bool()>& goes_on,
                                                   const CalibrationVoice& voice) {
  if (info.is_calibrated)
    throw CalibrationError("the glove is calibrated already: start its bridge without --calibration");
  try {
    return Guide(glove, info, options, clock, goes_on, voice).calibrate();
  } catch (const Ended&) {
    return std::nullopt;
  }
}

}  // namespace glissade::bridges
