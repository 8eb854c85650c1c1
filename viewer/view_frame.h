#pragma once

/// Frames: the state of the haptic loop for a viewer, at most 60 times a second.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/devices/haptic_state.h>
#include <glissade/viewer/view_scene.h>

namespace glissade::viewer {

/// Makes frames from the states of ticks. A frame shows the newest state, and the greatest force, age, lateness and
/// duration since the last frame. Not thread-safe; allocates.
///
/// All numbers in a frame are little endian. A frame begins with two numbers in double precision: the time of the tick
/// in seconds, and the number of the tick. All further numbers have single precision. A pose is x, y, z in metres
/// relative to `ViewScene::p_WO()`, followed by the quaternion w, x, y, z.
/// - The next ten numbers are: 1 if the contact set was late, otherwise 0; the greatest age of the contact set in ms;
///   the greatest lateness of a tick in µs; the greatest duration of a tick in µs; the number of frames that this
///   viewer has missed; the number of parts; the number of hands; the number of contacts; the number of patches; the
///   number of patches left out.
/// - For each part: the pose of the ghost G; the pose of the visible part V; the length of the lag's translation in
///   metres; the angle of the lag's rotation in radians; the state; the number of contacts that push.
/// - For each hand: the number of the part that the hand holds, or −1; the force in N (x, y, z); the torque in Nm (x,
///   y, z); the greatest force in N; the share of the contacts' force; 1 if the contacts were unsolved, otherwise 0;
///   the reasons of the server, as bits; the reasons of the glove, as bits; the energy in J; the activity, grasp, form
///   and touching segments of `hands::VisibleHand`; the condition that the grasp lacks (`grasping::GraspLack`); the
///   greatest torque on a joint in Nm; the number of links, 0 for a hand that is not present; the pose of each link.
/// - For each contact: the part; x, y, z in the part's frame V in metres; the normal in world axes.
/// - For each patch: the part; the number of contacts; x, y, z and the normal as for a contact; the extent in metres.
class FrameMaker {
 public:
  explicit FrameMaker(const ViewScene& scene);

  /// Takes the state of a tick.
  void add(const devices::HapticState& state);
  /// Whether a state was added since the last frame.
  bool has_news() const noexcept { return has_news_; }
  /// Makes the frame for a viewer that has missed no frames.
  std::string make();

 private:
  Eigen::Isometry3d X_OW_;
  std::vector<std::shared_ptr<const grasping::HandModel>> models_;
  std::vector<Eigen::Isometry3d> links_;
  devices::HapticState newest_;
  bool has_news_ = false;
  double age_ms_ = 0.0;
  double lateness_us_ = 0.0;
  double duration_us_ = 0.0;
  std::array<double, devices::kHapticHands> forces_N_{};
};

/// Appends the length of a frame (4 bytes) and the frame to `frames`.
void append_frame(std::string& frames, const std::string& frame);

/// Writes the number of missed frames into a frame.
void set_missed(std::string& frame, std::uint64_t missed);

}  // namespace glissade::viewer
