#pragma once

/// Gloves whose fingers grasp, and a server, each a process of its own over UDP multicast in a network namespace; what
/// their recording tells is checked by code that shares nothing with the simulation.

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/devices/glove_device.h>
#include <glissade/devices/haptic_state.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/grasping/hand_model.h>
#include <glissade/reference/grid_check.h>

#include "process.h"
#include "temporary_folder.h"

namespace glissade::test_support {

/// A time of a script: where the hand root is, and how far the fingers are closed, from 0 to 1.
struct HandPause {
  double time_s;
  Eigen::Isometry3d X_WH;
  double closed;
};

/// The thumb of the open hand and of the closed one: roll, bend at both joints, abduction, degrees.
struct ThumbShape {
  std::array<double, 4> open;
  std::array<double, 4> closed;
};

/// The script of a glove, as `glissade glove --script` reads it.
std::string script_text(const std::vector<HandPause>& pauses, const ThumbShape& thumb);

/// Runs `glissade record` with two gloves that have these scripts, for so many seconds.
ProgramResult record_two_hands(const TemporaryFolder& folder, const std::string& scene,
                               const std::array<std::string, 2>& scripts, double seconds, const std::string& log);

/// A tick, and what the gloves had told.
struct RecordedTick {
  devices::HapticState state;
  std::array<devices::GloveState, 2> gloves;
  std::chrono::nanoseconds time{0};
};

std::vector<RecordedTick> read_ticks(const std::string& log);

/// Which part each hand holds, −1 for none, one entry for each change.
using HeldByHands = std::pair<std::int32_t, std::int32_t>;
std::vector<HeldByHands> holds_of(const std::vector<RecordedTick>& ticks);

/// The visible bodies of a tick: one part, hands, and obstacles.
class VisibleBodies {
 public:
  VisibleBodies(std::shared_ptr<const geometry::TriangleMesh> part,
                const std::vector<reference::PlacedMesh>& obstacles);

  /// Whether any two of them collide that must not.
  bool collide(const devices::HapticState& state);
  bool collides(const hands::VisibleHand& hand, const Eigen::Isometry3d& X_WV);

 private:
  std::shared_ptr<const geometry::TriangleMesh> part_;
  reference::GridCheck part_check_;  // in the frame of the part
  reference::GridCheck obstacle_check_;
  grasping::HandModel model_ = grasping::make_hand();
  std::vector<Eigen::Isometry3d> X_WL_;
};

/// Expects that no force and no torque exceeds the limits of the simulated glove, or changes faster than they allow.
/// Returns the greatest force, N.
double expect_nothing_that_jumps(const std::vector<RecordedTick>& ticks);

}  // namespace glissade::test_support
