#pragma once

/// One held part of a simulation: its holder, its ghost and target, and its motion over the last calls.

#include <memory>
#include <optional>

#include <Eigen/Geometry>

#include <glissade/contact/contact_body.h>
#include <glissade/contact/sliding_result.h>
#include <glissade/contact/sliding_rules.h>
#include <glissade/contact/spring.h>
#include <glissade/geometry/displacement.h>

#include "cycle/rest_watch.h"
#include "cycle/spiral_search.h"

namespace glissade::contact {

/// Not thread-safe.
struct HeldPartState {
  std::shared_ptr<const SlidingPart> part_V;
  Eigen::Vector3d p_Vref;  // the reference point: the compliance point of the hold
  Metaphor metaphor;
  CouplingStiffness stiffness;
  double margin;  // metres
  double lever;   // metres: bound of the distance of all points that move with the part from its reference point
  std::optional<PartScript> script;
  bool may_search;  // in a spiral
  SpiralSearch spiral_search;
  RestWatch rest_watch{};

  SlidingResult result{};
  Eigen::Isometry3d X_WS = Eigen::Isometry3d::Identity();           // where steps aim, mostly X_WT
  Eigen::Isometry3d X_WG_previous = Eigen::Isometry3d::Identity();  // the ghost in the last call
  double ghost_motion = 0.0;                                        // metres, in this tick
  geometry::Displacement offset{};  // from the ghost to the target, since the hand took hold
  double closing = 0.0;             // metres by which the offset shrank in this tick
  double moved = 0.0;               // metres, in this tick
  // Poses before the last call and before this one: friction compares them to find the contacts that slip.
  Eigen::Isometry3d X_WV_before_last = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d X_WV_before = Eigen::Isometry3d::Identity();
  geometry::Displacement previous_lag{};  // from the part to its target, at the end of the last call
  double slew = 0.0;                      // metres by which the lag may change in this tick

  bool is_scripted() const { return script.has_value(); }
  bool is_held() const { return result.state != SlidingState::kReleased; }
  Eigen::Vector3d p_Wref() const { return result.X_WV * p_Vref; }
  /// From the part to its target.
  geometry::Displacement lag() const;

  /// Leaves the part where it is: its target is its own pose, so nothing pushes it.
  void rest(SlidingState state);
  /// A hand takes hold, with the ghost at the rigid pose X_WG and the reference point at `p_Vref_of_hold`. The part
  /// rests then; one already held by force feedback keeps the wrench on it.
  void grasp(const Eigen::Isometry3d& X_WG, const Eigen::Vector3d& p_Vref_of_hold);

  /// Begins a call.
  void begin_tick();
  /// Moves the ghost to the rigid pose X_WG and chooses the target; `milliseconds` as in `advance`.
  void follow(const Eigen::Isometry3d& X_WG, double milliseconds);
  /// Turns the target of the rubber band with the part.
  void turn_target();
  /// Ends the cycle with this number, from 1; all contacts within `reach` (metres) are known.
  void end_cycle(int number, double reach);
  /// Ends the answer to a ghost, `milliseconds` after the last one.
  void end_tick(double milliseconds);

 private:
  void move_reference(const Eigen::Vector3d& p_Vref_to);
  void aim();
  SlidingState classify() const;
};

}  // namespace glissade::contact
