#pragma once

/// Whether a flex value of a clasped hand alone could come nearer to its target: an independent check of the clasp.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glissade/geometry/triangle_mesh.h>
#include <glissade/grasping/kinematic_chain.h>

#include "mesh_oracle.h"

namespace glissade::test_support {

/// Measures distances triangle by triangle, without trees.
class NearerPosture {
 public:
  /// The object in W. Cost: links × triangles of the object.
  NearerPosture(const grasping::KinematicChain& chain, const geometry::TriangleMesh& object_W);

  /// The first flex value that alone can turn towards the target until a point of the hand has moved by `farther`
  /// (metres), or to the target if this is less but more than half as far, while every link that it moves stays
  /// farther than `margin` from the object, or farther than it is now if it is nearer, in eight places on the way.
  /// None: the posture is as near as it can be.
  std::optional<std::size_t> find(const grasping::Posture& posture, const grasping::Posture& target, double margin,
                                  double farther) const;

 private:
  /// Metres that the fastest point of the hand moves per radian.
  double speed(const grasping::Posture& posture, std::size_t value) const;
  /// For each link how near to the object it may come.
  std::vector<double> clearances(const grasping::Posture& posture, double margin) const;
  bool is_free(const grasping::Posture& posture, std::size_t value, std::span<const double> clearances) const;

  const grasping::KinematicChain& chain_;
  std::vector<std::optional<MeshOracle>> distances_;  // by link
};

}  // namespace glissade::test_support
