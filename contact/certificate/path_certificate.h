#pragma once

/// The certificate that a step of the parts keeps clear of all bodies on its whole path, not only at its end. Two
/// sheets without thickness can pass through each other with no colliding pose in between; a path certificate rules
/// that out.
///
/// A box pair is certified as a whole if one direction, such as the normal of the flat side of either box, separates
/// the contents of both at the start and at the end of the step by more than the minimum clearance and the curvature of
/// the paths. So a plane patch that slides over another one is certified at once, however finely it is tessellated.
/// Boxes that fail are opened, down to triangle pairs (`triangle_certificate.h`). The certificate may take several
/// calls of the simulation.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/geometry/displacement.h>

#include "certificate/fixed_direction.h"
#include "certificate/lasting_separation.h"
#include "certificate/moving_bodies.h"
#include "certificate/pairs_to_certify.h"
#include "certificate/separating_planes.h"
#include "certificate/triangle_certificate.h"
#include "work/work_budget.h"

namespace glissade::contact {

/// A triangle pair that could not be certified, and the direction that separated it at the start of the step.
struct UncertifiedPair : TrianglesOfBodies {
  Eigen::Vector3d n_W;  ///< unit, from the obstacle to the part
};

/// A triangle pair that a direction separated on the whole path, or at least at its start.
struct SeparatedPair {
  std::size_t place;  ///< among the pairs to certify
  FixedDirection direction;
};

/// Two bodies at both ends of a step.
struct PathOfBodies {
  Eigen::Isometry3d X_OV_begin;  ///< the part in the frame of the obstacle
  Eigen::Isometry3d X_OV_end;
  double needed;  ///< metres: a pair that a direction fixed to the obstacle separates so far at both ends is certified
  double needed_turning;  ///< metres: the same for a direction that turns with the part, past corners in the ball
  double far;             ///< metres: a pair that is farther apart at the beginning is certified
};

/// Not thread-safe.
class PathCertificate {
 public:
  /// The scene must outlive this object.
  explicit PathCertificate(const ContactScene& scene) : scene_(scene), bodies_(scene) {}

  /// Begins a step in which all parts move at once, each from its present pose along its displacement; `displacements`
  /// has one entry for each part.
  void begin_step(std::span<const geometry::Displacement> displacements);
  /// The pose of a body at the end of this step.
  const Eigen::Isometry3d& pose_at_end(std::int32_t body) { return bodies_.pose(body, MovingBodies::kMoments); }
  /// Bound (metres) of the sum of the deviations of any two points from their chords in this step.
  double curvature() const { return bodies_.most_curvature(); }
  /// The ends of this step for two bodies; none if the obstacle moves, too: the bounds of the error between both ends
  /// are for an obstacle that stands still.
  std::optional<PathOfBodies> path_of(const BodyPair& bodies, const BallAboutPart& ball);
  /// Begins the certificate of all of `to_certify` for this step. `to_certify` and the poses must stay as they are
  /// until `go_on` returns true.
  void begin(std::span<const PairToCertify> to_certify);
  /// The same for the parts from `first_mover` on, which follow `motion`. They also take at most so much (metres)
  /// of every margin, if this is given.
  void begin(const BodiesMotion& motion, std::size_t first_mover, std::span<const PairToCertify> to_certify,
             std::optional<double> most_taken);
  /// Goes on until all pairs have been looked at or the budget is used up, at least with one pair of boxes or leaves or
  /// up to eight of triangles. Returns whether all have been.
  bool go_on(WorkBudget& budget);
  /// The triangle pairs that could not be certified so far.
  const std::vector<UncertifiedPair>& failures() const { return failures_; }
  /// Triangle pairs among those to certify for which a direction was sought, with the one that was found.
  std::span<const SeparatedPair> separated() const { return separated_; }

  /// Smallest distance (metres) that is certain in spite of rounding, for the present poses of the bodies.
  double certain_distance() const { return bodies_.certain_distance(); }

 private:
  /// An item with the centre of its box, in the world, at the beginning and at the end of the step.
  struct MovingItem {
    TreeItem item;
    std::array<Eigen::Vector3d, 2> c_W;
  };
  /// A body of the pair at hand.
  struct MovingBody {
    std::int32_t number = -1;
    const ContactBody* body = nullptr;
    std::array<const Eigen::Isometry3d*, 2> X_WB{};  ///< at the beginning and at the end of the step
  };

  /// Two items of the bodies at hand, still to be certified.
  struct OpenItems {
    MovingItem item_O;
    MovingItem item_V;
  };

  /// A triangle of each of the bodies at hand.
  struct Triangles {
    std::int32_t of_obstacle;
    std::int32_t of_part;
    Eigen::Vector3d n_hint;  ///< in world axes; zero if none is known
    std::size_t place;       ///< among the pairs to certify, if it is itself one of these
  };

  void forget_bodies();
  void select(const BodyPair& bodies);
  /// Whether directions are sought that serve for the next steps too. They are fixed to either body.
  bool seeks_lasting_directions() const { return keeps_directions_ && !obstacle_moves_; }
  MovingBody moving(std::int32_t body);
  static MovingItem moving(const TreeItem& item, const MovingBody& body);
  void prove(const PairToCertify& pair_to_certify, WorkBudget& budget);
  void prove(const OpenItems& items, WorkBudget& budget);
  bool are_apart(const MovingItem& item_O, const MovingItem& item_V) const;
  bool separates(const Eigen::Vector3d& n_W, const MovingItem& item_O, const MovingItem& item_V) const;
  bool separates(const Eigen::Vector3d& n_W, std::int32_t triangle_O, std::int32_t triangle_V) const;
  void prove(const Triangles& triangles, WorkBudget& budget);
  void start_separations();
  double needed_turning(const BallAboutPart& ball);
  void prove_waiting(WorkBudget& budget);
  void certify(const Triangles& triangles, WorkBudget& budget);
  void note_direction(const Triangles& triangles, const FixedDirection& direction);
  void prove_leaves(std::uint32_t leaf_O, std::uint32_t leaf_V, WorkBudget& budget);

  const ContactScene& scene_;
  MovingBodies bodies_;
  bool keeps_directions_ = false;        // of the step: those that serve for the next steps too are worth a search
  double rounding_ = 0.0;                // metres: smaller distances are not certain
  std::optional<double> most_taken_;     // metres of the margins
  std::span<const PairToCertify> rest_;  // pairs that have not been begun
  std::vector<OpenItems> open_;          // of the pair at hand, the last one next
  std::size_t place_ = 0;                // of the pair at hand among those to certify
  std::vector<UncertifiedPair> failures_;
  std::vector<SeparatedPair> separated_;

  // Of the pair of bodies at hand:
  MovingBody obstacle_;
  MovingBody part_;
  bool obstacle_moves_ = false;
  bool moves_ = false;  // either of them
  double min_clearance_ = 0.0;
  double far_ = 0.0;             // metres: items farther apart keep the minimum clearance in any case
  double needed_ = 0.0;          // metres of gap at both ends that keep the minimum clearance in between
  BallAboutPart ball_{};         // at the beginning
  double needed_turning_ = 0.0;  // metres: the same as `needed_` for directions that turn with the part in this ball
  LastingSeparations separations_;
  std::array<Triangles, geometry::kPairsToMeasure> waiting_;  // those of `separations_`
};

}  // namespace glissade::contact
