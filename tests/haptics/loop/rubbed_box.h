#pragma once

/// A wearer presses a box on a plate and rubs it to and fro, with the simulated glove or the arm of a model.

#include <chrono>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/devices/glove_model.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/grasping/grasp_simulation.h>

#include "disturbed_loop.h"
#include "held_part.h"
#include "holding_arm.h"
#include "loop/answer.h"
#include "poses.h"

namespace glissade::haptics {

using test_support::holding_arm;

class RubbedBox : public DisturbedWorld {
 public:
  static constexpr double kEdge = 0.04;
  static constexpr double kAim = 25e-3;     ///< so far the wearer aims beyond the box on the plate
  static constexpr double kBeside = 10e-3;  ///< so that the hand feels a torque, too

  RubbedBox() : glove_(script(kBeside)) {}
  /// The hand holds the box `beside` (metres) its middle.
  explicit RubbedBox(const devices::GloveModel& arm, double beside = kBeside) : glove_(script(beside), {}, arm) {}

  devices::SimulatedGlove& glove() override { return glove_; }
  HapticKernel& kernel() override { return kernel_; }
  ContactSet at_start() override { return answerer_.at_start(); }
  void answer(const Ghosts& ghosts, ContactSet& set) override { answerer_.answer(ghosts, kTickPeriod, set); }

 private:
  /// Down onto the plate within half a second, 25 mm too far, and then to and fro by 10 mm at 20 mm/s.
  static geometry::PoseTrajectory script(double beside) {
    using std::chrono::milliseconds;
    std::vector<geometry::TimedPose> rows{{milliseconds(0), test_support::at(beside, 0.0, 0.5 * kEdge + 1e-3)}};
    for (int i = 1; i <= 20; ++i) {
      const double x = beside + (i % 2 == 0 ? 5e-3 : -5e-3);
      rows.push_back({milliseconds(500 * i), test_support::at(x, 0.0, 0.5 * kEdge - kAim)});
    }
    return geometry::PoseTrajectory(rows);
  }

  devices::SimulatedGlove glove_;
  grasping::GraspSimulation sliding_{
      {test_support::obstacle_of(geometry::make_plate({0.5, 0.5}, 2))},
      {{.part_V = test_support::cube(kEdge), .X_WV_start = test_support::at(0.0, 0.0, 0.5 * kEdge + 1e-3)}}};
  Answerer answerer_{sliding_};
  HapticKernel kernel_{kernel_parts(sliding_.parts()), {{glove_.descriptor(), 0}}};
};

}  // namespace glissade::haptics
