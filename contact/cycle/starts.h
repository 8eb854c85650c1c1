#pragma once

/// Bodies that are too close at the start. A minimum clearance that was lowered at the start is restored as the bodies
/// come apart. A part leaves its seats as it comes out of them, and is pushed out of deep overlaps.

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/dop_query.h>

#include "cycle/simulated_parts.h"

namespace glissade::contact {

/// A push out of an overlap.
struct WayOut {
  std::size_t seat;
  Eigen::Vector3d n_W;    ///< unit
  Eigen::Vector3d end_W;  ///< where the origin of the part will be
  double left;            ///< metres
  int blocked_calls = 0;  ///< in a row, in which other bodies have held the part
};

/// Not thread-safe.
class Starts {
 public:
  /// Lowers the minimum clearances of bodies that are near. `shared` must outlive this object.
  explicit Starts(SimulatedParts& shared);

  /// Drops the seats that parts have left. Returns whether it dropped any; then their insets are gone.
  bool leave_seats();

  /// The pairs of bodies, in ascending order, that insets stand in for, and those for which insets do not count.
  std::span<const BodyPair> ignored() const { return ignored_; }

  /// Aims parts out of overlaps, by at most `most` metres.
  void depenetrate(double most);
  /// Metres by which `depenetrate` may move a part in this tick; 0 when it moves none.
  double depenetration() const { return depenetration_; }
  /// The pushes of this tick, the deepest overlap first.
  std::span<const WayOut> ways_out() const { return ways_out_; }
  bool is_pushed_out(std::size_t part) const;

  /// Raises the minimum clearance of bodies that have come apart since their start, up to kMinClearanceOfMargin of the
  /// margin.
  void restore_min_clearances();

 private:
  bool is_seated(const BodyPair& bodies) const;
  std::size_t part_of(std::size_t seat) const {
    return static_cast<std::size_t>(shared_.seats[seat].bodies.part) - shared_.scene.obstacles().size();
  }
  void look(const BodyPair& bodies);
  void find_ignored();
  void push_on(WayOut& way, double most);
  double gap_of(const BodyPair& pair, double limit);

  SimulatedParts& shared_;
  std::vector<std::size_t> seats_;  // that are not left
  std::vector<BodyPair> ignored_;
  std::vector<WayOut> ways_out_;
  std::vector<BodyPair> near_starts_;  // pairs whose minimum clearance is lowered
  collision::QueryWorkspace workspace_;
  double depenetration_ = 0.0;  // metres
};

}  // namespace glissade::contact
