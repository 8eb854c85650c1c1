#pragma once

/// A mesh prepared for sliding contact: as a part, i.e. an object that a hand or a script moves, or as an obstacle.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <Eigen/Geometry>

#include <glissade/collision/convex_hull.h>
#include <glissade/collision/dop_tree.h>
#include <glissade/collision/query_types.h>
#include <glissade/geometry/mesh_topology.h>

namespace glissade::contact {

class ObbTree;

/// A mesh with its DOP-tree (a bounding-volume hierarchy), convex hull and topology. Immutable after construction, so
/// safe to share between threads.
struct ContactBody {
  /// Throws std::invalid_argument for a null mesh, and as `DopTree` does. Cost O(n log n) for n triangles.
  explicit ContactBody(const std::shared_ptr<const geometry::TriangleMesh>& mesh);
  ContactBody(const ContactBody&) = delete;
  ContactBody& operator=(const ContactBody&) = delete;
  ~ContactBody();

  collision::DopTree tree;
  collision::ConvexHull hull;
  geometry::MeshTopology topology;
  /// The triangles that own a vertex that can stop another body, and half selected those that own such an edge: an edge
  /// stops only edges and vertices. `MeshTopology` assigns each edge and each vertex to one triangle, its owner. The
  /// selected pairs are those that `MeshTopology::can_stop_each_other` tells.
  collision::TriangleSelection features;

 private:
  friend struct ObbAccess;
  std::unique_ptr<const ObbTree> obbs_;  // for path certificates
};

/// In radii of a part: how far a compliance point may be from the centre of its bounding box.
inline constexpr double kFarthestPoint = 10.0;

/// A part that a hand or a script moves, in its own frame V. A displacement of the part is the translation of a
/// reference point and a rotation about that point; the coupling, the virtual spring between hand and part, acts at the
/// same point, the compliance point. A force at this point turns the part little, so a peg that is coupled at its tip
/// finds its hole, where one that is coupled at its middle tips and jams. Hands with fingers are coupled where they
/// grip the part (`MultiPartSliding::grasp`), unless the point was chosen here.
class SlidingPart : public ContactBody {
 public:
  /// The compliance point is the centre of the bounding box: no point of the part is much farther from it than half of
  /// the part's size, and a rotation moves the points of the part little. Throws as `ContactBody` does.
  explicit SlidingPart(const std::shared_ptr<const geometry::TriangleMesh>& mesh);

  /// The compliance point is `p_Vref` (metres). Throws std::invalid_argument also for a point that is not finite, or
  /// farther from the centre of the bounding box than kFarthestPoint times the farthest vertex.
  SlidingPart(const std::shared_ptr<const geometry::TriangleMesh>& mesh, const Eigen::Vector3d& p_Vref);

  const Eigen::Vector3d& p_Vref() const { return p_Vref_; }
  bool has_chosen_point() const { return has_chosen_point_; }
  /// ρ: the largest distance of a vertex from the reference point, metres.
  double radius() const { return radius_; }

 private:
  Eigen::Vector3d p_Vref_;
  bool has_chosen_point_;
  double radius_;
};

/// The bodies of mesh files (OBJ, STL, PLY, glTF) whose unit is `scale` metres, e.g. 1e-3 for millimetres. Triangles
/// without area are left out, and so is what `geometry::import_mesh` warns of; only that function tells of it. Throw
/// std::invalid_argument, naming the file, as `geometry::import_mesh` does.
std::shared_ptr<const ContactBody> load_body(const std::filesystem::path& file, double scale = 1.0);
/// The same for a part, whose compliance point is the centre of its bounding box.
std::shared_ptr<const SlidingPart> load_part(const std::filesystem::path& file, double scale = 1.0);

/// A body that stands still. Several obstacles may share one `ContactBody`.
struct Obstacle {
  std::shared_ptr<const ContactBody> body;
  Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
  std::string name = "an obstacle";  ///< for messages
  /// The gap (metres) at which contacts with this obstacle stop a part; default: the margin of the part. A smaller
  /// margin allows a tighter fit, a larger margin leaves more clearance. At most kGreatestMargin_m (`sliding_rules.h`).
  std::optional<double> margin{};
};

}  // namespace glissade::contact
