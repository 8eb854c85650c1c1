#pragma once

/// A mesh made ready for sliding contact: its DOP-tree, tight boxes for proofs, its convex hull, and
/// its topology with the triangles that matter to contacts.

#include <memory>

#include <glissade/collision/convex_hull.h>
#include <glissade/collision/dop_tree.h>
#include <glissade/collision/mesh_topology.h>
#include <glissade/collision/triangle_selection.h>
#include <glissade/haptics/tight_boxes.h>

namespace glissade::haptics {

/// Immutable after construction, so safe to share between threads.
struct ContactBody {
  /// Throws std::invalid_argument as DopTree does. Cost O(n log n).
  explicit ContactBody(const std::shared_ptr<const collision::TriangleMesh>& mesh)
      : tree(mesh), boxes(tree), hull(*mesh), topology(*mesh), features(tree, [this](std::int32_t triangle) {
          return topology.answers_for_features(triangle);
        }) {}

  collision::DopTree tree;
  TightBoxes boxes;
  collision::ConvexHull hull;
  collision::MeshTopology topology;
  collision::TriangleSelection features;  ///< that answer for any edge or vertex that can stop another body
};

/// The part in the hand, in its own frame V. Displacements and the coupling act at a reference point fixed in it: the
/// centre of its bounding box, so that rotation and translation are as independent as its shape allows.
struct SlidingPart : ContactBody {
  using ContactBody::ContactBody;

  const Eigen::Vector3d& p_Vref() const { return tree.center(); }
  /// ρ: the largest distance of a vertex from the reference point, metres.
  double radius() const { return tree.radius(); }
};

}  // namespace glissade::haptics
