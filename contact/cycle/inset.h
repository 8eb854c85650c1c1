#pragma once

/// A closed surface with all of its faces moved inwards, so that what it encloses is smaller. It tells how deep a part
/// overlaps a body: by how far its faces must move until it is free.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/dop_query.h>
#include <glissade/contact/contact_body.h>

namespace glissade::contact {

/// Not thread-safe.
class Inset {
 public:
  /// Cost O(n log n).
  explicit Inset(const geometry::TriangleMesh& mesh);

  /// Whether the mesh encloses anything: an open one has no inset.
  bool exists() const { return !inwards_.empty(); }

  /// How deep the part at X_OV is in the body: the least distance (metres) by which all of its faces must move inwards
  /// until it touches the body nowhere, and is not inside of it. 0 if `resolution` (metres) suffices: then they only
  /// touch. Nothing where no distance does. Precision: `resolution`, or a thousandth. Cost: some refits and queries.
  std::optional<double> overlap(const ContactBody& body, const Eigen::Isometry3d& X_OV, double resolution);

  /// The mesh with all faces so much (metres) further inside. Triangles and vertices keep their numbers.
  geometry::TriangleMesh at(double depth);

 private:
  bool move(double depth);

  geometry::TriangleMesh mesh_;
  std::vector<std::int8_t> signs_;                 // by triangle, as `outward_signs`
  std::vector<Eigen::Vector3d> inwards_;           // by vertex: its way, in depths
  std::shared_ptr<geometry::TriangleMesh> moved_;  // of the tree
  std::optional<collision::DopTree> tree_;
  collision::QueryWorkspace workspace_;
};

}  // namespace glissade::contact
