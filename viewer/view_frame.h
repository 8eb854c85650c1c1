#pragma once

/// The state of the haptic loop as a viewer gets it, at most 60 times a second.

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

/// Makes frames of the states of ticks. A frame shows the newest state, and the greatest force, age, lateness and
/// duration since the last frame. Not thread-safe; allocates.
///
/// A frame is little endian: two numbers in double precision, the time of the tick in seconds and its number; then
/// numbers in single precision. First ten: 1 if the contact set was late or else 0; its greatest age in ms; the
/// greatest lateness of a tick and the greatest duration of one in µs; the number of frames that this viewer has
/// missed; the numbers of parts, hands, contacts and patches, and of patches left out. For each part: the poses of
/// ghost G and visible part V, each as x, y, z in metres and w, x, y, z, relative to `ViewScene::p_WO()`; how far its
/// reference point lags in metres, and its angle in radians; its state;
/// the number of contacts that push. For each hand: the number of the part that it holds or −1; force in N; torque in
/// Nm; the greatest force; the share of the contacts' force; 1 if they were unsolved or else 0; the reasons of the
/// server and those of the glove, as bits; the energy in J; activity; grasp, its form, and the segments that touch as
/// `hands::VisibleHand` has them, what they lack to hold (`grasping::GraspLack`); the greatest torque on a joint in
/// Nm; the number of its links, 0 where it is not present, and the pose of each. For each contact: the part; x, y, z in
/// the part's frame V in metres; the normal in world axes. For each patch: the part; the number of contacts; x, y, z
/// and the normal as for a contact; the extent in metres.
class FrameMaker {
 public:
  explicit FrameMaker(const ViewScene& scene);

  /// Takes the state of a tick.
  void add(const devices::HapticState& state);
  /// Whether there is one since the last frame.
  bool has_news() const noexcept { return has_news_; }
  /// The frame, for a viewer that has missed none.
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

/// Appends a frame to others, after its length in 4 bytes.
void append_frame(std::string& frames, const std::string& frame);

/// Writes into a frame how many the viewer has missed.
void set_missed(std::string& frame, std::uint64_t missed);

}  // namespace glissade::viewer
