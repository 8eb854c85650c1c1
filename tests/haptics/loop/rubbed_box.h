#pragma once

/// A wearer presses a box on a plate and rubs it to and fro. Glove, link, haptic loop and simulation take turns on a
/// simulated clock, with the times of a real loop: a tick that takes longer than a period makes the loop skip
/// deadlines.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/devices/safety_envelope.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/grasping/grasp_simulation.h>
#include <glissade/haptics/haptic_kernel.h>
#include <glissade/realtime/periodic_loop.h>

#include "held_part.h"
#include "loop/answer.h"
#include "poses.h"

namespace glissade::haptics {

class RubbedBox {
 public:
  using Time = std::chrono::nanoseconds;

  /// What goes wrong. Times are since the start. An empty function disturbs nothing.
  struct Disturbance {
    std::function<bool(Time now)> holds_simulation{};           ///< the simulation does not answer now
    std::function<void(Time now, ContactSet& set)> corrupts{};  ///< changes the set of the tick that starts now
    std::function<Time(Time start)> tick_time{};                ///< how long the tick that starts now takes
  };

  /// Force and torque of a command.
  struct Given {
    Time time{0};
    Eigen::Vector3d f = Eigen::Vector3d::Zero();
    Eigen::Vector3d t = Eigen::Vector3d::Zero();
  };

  explicit RubbedBox(Disturbance disturbance) : disturbance_(std::move(disturbance)) {}

  /// Until that time since the start. `see_server` gets each command of the kernel; `see_hand` what the glove gives to
  /// the hand, every millisecond.
  void run(Time end, const std::function<void(const Given&)>& see_server,
           const std::function<void(const Given&)>& see_hand) {
    while (now_ < end) {
      now_ += kTickPeriod;
      see_hand(move_hand());
      while (next_start() <= now_)
        see_server(tick());
      answer();
    }
  }

  const realtime::PeriodicStatistics& statistics() const { return statistics_; }

 private:
  static constexpr double kEdge = 0.04;

  /// Down onto the plate within half a second, 25 mm too far, and then to and fro by 10 mm at 20 mm/s.
  static geometry::PoseTrajectory script() {
    using std::chrono::milliseconds;
    std::vector<geometry::TimedPose> rows{{milliseconds(0), beside(0.0, 0.5 * kEdge + 1e-3)}};
    for (int i = 1; i <= 20; ++i)
      rows.push_back({milliseconds(500 * i), beside(i % 2 == 0 ? 5e-3 : -5e-3, 0.5 * kEdge - 25e-3)});
    return geometry::PoseTrajectory(rows);
  }

  /// The hand holds the box 10 mm beside its middle, so that it feels a torque too.
  static Eigen::Isometry3d beside(double x, double z) { return test_support::at(x + 10e-3, 0.0, z); }

  Time next_start() const { return std::max(schedule_.deadline(), busy_until_); }

  /// The command is sent when the tick ends.
  Given tick() {
    const Time start = next_start();
    deliver(start);
    ContactSet set = set_;
    if (disturbance_.corrupts) disturbance_.corrupts(start, set);
    const devices::GloveState* const newest = &state_;
    const HapticTick tick = kernel_.tick({&newest, 1}, set, start);
    busy_until_ = start + (disturbance_.tick_time ? disturbance_.tick_time(start) : Time(0));
    schedule_.finish_tick(start, busy_until_, statistics_);
    on_its_way_ = tick;
    const devices::GloveCommand& values = tick.hands[0].command.values();
    return {start, values.f_H_W, values.t_H_W};
  }

  void deliver(Time time) {
    if (!on_its_way_ || busy_until_ > time) return;
    command_ = on_its_way_->hands[0].command.values();
    ghosts_ = on_its_way_->ghosts;
    on_its_way_.reset();
  }

  /// A period of the glove: a measurement, and the newest command until the next one.
  Given move_hand() {
    deliver(now_);
    state_ = glove_.step(kTickPeriod, given_);
    given_ = envelope_.limit(command_, state_, now_);
    state_.link_delay = envelope_.link_delay();
    return {now_, given_.values().f_H_W, given_.values().t_H_W};
  }

  void answer() {
    if (!ghosts_ || (disturbance_.holds_simulation && disturbance_.holds_simulation(now_))) return;
    answerer_.answer(*ghosts_, kTickPeriod, set_);
    ghosts_.reset();
  }

  Disturbance disturbance_;
  Time now_{0};
  devices::SimulatedGlove glove_{script()};
  devices::GloveState state_ = glove_.state();                  // as the haptic loop knows it
  devices::SafetyEnvelope envelope_{glove_.descriptor(), 6.0};  // at the glove's end
  devices::GloveCommand command_;                               // the newest that came
  devices::SafeCommand given_;
  grasping::GraspSimulation sliding_{
      {test_support::obstacle_of(geometry::make_plate({0.5, 0.5}, 2))},
      {{.part_V = test_support::cube(kEdge), .X_WV_start = test_support::at(0.0, 0.0, 0.5 * kEdge + 1e-3)}}};
  Answerer answerer_{sliding_};
  ContactSet set_ = answerer_.at_start();
  HapticKernel kernel_{kernel_parts(sliding_.parts()), {{glove_.descriptor(), 0}}};
  realtime::PeriodicSchedule schedule_{kTickPeriod, kTickPeriod};
  realtime::PeriodicStatistics statistics_;
  Time busy_until_{0};
  std::optional<HapticTick> on_its_way_;
  std::optional<Ghosts> ghosts_;  // that the simulation has not answered
};

}  // namespace glissade::haptics
