#pragma once

/// The proof that a step of the parts stays clear of everything on its whole way, not only at its end. Two sheets
/// without thickness can pass through each other without any pose in between that collides; a path certificate rules
/// that out.
///
/// Pairs of boxes are proved apart as a whole where the plane of the flat side of either separates all that both hold,
/// at the start and at the end of the step, by more than the min_clearance and the curvature of the paths: so a plane
/// patch that slides over another is proved free at once, however finely it is cut. Boxes that are not are opened, down
/// to pairs of triangles (`triangle_certificate.h`).

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/geometry/displacement.h>

#include "certificate/moving_bodies.h"
#include "certificate/pairs_to_certify.h"
#include "certificate/triangle_certificate.h"

namespace glissade::haptics {

/// A pair that could not be proved apart, and the direction that held it apart at the start of the step.
struct UncertifiedPair : TrianglesOfBodies {
  Eigen::Vector3d n_W;  ///< unit, from the obstacle to the part
};

/// Not thread-safe.
class PathCertificate {
 public:
  /// The scene must outlive this object.
  explicit PathCertificate(const ContactScene& scene) : scene_(scene), bodies_(scene) {}

  /// Tries to keep all `to_certify` while every part goes from where it is placed along its displacement, all of them
  /// at once; `displacements` has one for each. Replaces `failures` by the pairs of triangles it could not prove apart.
  /// Returns whether there are none.
  bool prove(std::span<const geometry::Displacement> displacements, std::span<const PairToCertify> to_certify,
             std::vector<UncertifiedPair>& failures);

  /// Metres: of bodies where they are placed, less than this is no certain distance.
  double certain_distance() const { return bodies_.certain_distance(); }

 private:
  /// An item whose box is, at the beginning and at the end of the step, about `c_W`.
  struct MovingItem {
    TreeItem item;
    std::array<Eigen::Vector3d, 2> c_W;
  };
  /// One of the bodies of an pair_to_certify.
  struct MovingBody {
    std::int32_t number = -1;
    const ContactBody* body = nullptr;
    std::array<const Eigen::Isometry3d*, 2> X_WB{};  ///< at the beginning and at the end of the step
  };

  void select(const BodyPair& bodies);
  MovingBody moving(std::int32_t body);
  static MovingItem moving(const TreeItem& item, const MovingBody& body);
  void prove(const PairToCertify& pair_to_certify);
  void walk(const MovingItem& item_O, const MovingItem& item_V);
  bool are_apart(const MovingItem& item_O, const MovingItem& item_V) const;
  bool separates(const Eigen::Vector3d& n_W, const MovingItem& item_O, const MovingItem& item_V) const;
  void prove_triangles(std::int32_t triangle_O, std::int32_t triangle_V, const Eigen::Vector3d& n_hint);
  void prove_leaves(std::uint32_t leaf_O, std::uint32_t leaf_V);

  const ContactScene& scene_;
  MovingBodies bodies_;
  double rounding_ = 0.0;  // metres: distances below this are not certain
  std::vector<UncertifiedPair>* failures_ = nullptr;

  // Of the pair of bodies that is being proved:
  MovingBody obstacle_;
  MovingBody part_;
  bool moves_ = false;
  double min_clearance_ = 0.0;
  double far_ = 0.0;     // metres at which nothing can come as near as the min_clearance
  double needed_ = 0.0;  // metres of gap at both ends, so that the min_clearance is kept in between
};

}  // namespace glissade::haptics
