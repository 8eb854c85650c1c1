#pragma once

/// A mesh prepared for sliding contact. The mesh belongs to a part (an object that a hand or a script moves) or to an
/// obstacle.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include <Eigen/Geometry>

#include <glissade/base/export.h>
#include <glissade/collision/convex_hull.h>
#include <glissade/collision/dop_tree.h>
#include <glissade/collision/query_types.h>
#include <glissade/geometry/mesh_topology.h>

namespace glissade::contact {

/// A mesh with its DOP-tree (a bounding-volume hierarchy), convex hull and topology. Immutable after construction, so
/// threads may share it.
struct GLISSADE_EXPORT ContactBody {
  /// Throws std::invalid_argument for a null mesh. Also throws what the constructor of `DopTree` throws. Cost O(n log
  /// n) for n triangles.
  explicit ContactBody(const std::shared_ptr<const geometry::TriangleMesh>& mesh);
  ContactBody(const ContactBody&) = delete;
  ContactBody& operator=(const ContactBody&) = delete;
  ~ContactBody();

  collision::DopTree tree;
  collision::ConvexHull hull;
  geometry::MeshTopology topology;
  /// `MeshTopology` assigns each edge and each vertex to one triangle, its owner. A triangle is selected if it owns a
  /// vertex that can stop another body. An edge stops only edges and vertices, so a triangle that owns an edge that can
  /// stop another body is half selected. The selected pairs are the pairs for which `MeshTopology::can_stop_each_other`
  /// is true.
  collision::TriangleSelection features;
  std::shared_ptr<const collision::ObbTree> obbs;  ///< of `tree`, for path certificates
};

/// The largest allowed distance of a compliance point from the centre of the part's bounding box, in radii of the part.
inline constexpr double kFarthestPoint = 10.0;

/// A part that a hand or a script moves. V is the frame of the part. A displacement of the part is the translation of a
/// reference point and a rotation about that point. The coupling, i.e. the virtual spring between hand and part, acts
/// at the same point. Therefore the reference point is also called the compliance point. A force at the compliance
/// point hardly turns the part. So a peg coupled at its tip finds its hole, whereas a peg coupled at its middle tilts
/// and jams. The coupling of a hand with fingers acts where the fingers grip the part (see `MultiPartSliding::grasp`),
/// unless the constructor was given a compliance point.
class GLISSADE_EXPORT SlidingPart : public ContactBody {
 public:
  /// The compliance point is the centre of the bounding box, so the points of the part move little in a rotation.
  /// Throws what the constructor of `ContactBody` throws.
  explicit SlidingPart(const std::shared_ptr<const geometry::TriangleMesh>& mesh);

  /// The compliance point is `p_Vref` (metres). Also throws std::invalid_argument if `p_Vref` is not finite, or if its
  /// distance from the centre of the bounding box exceeds kFarthestPoint times that of the farthest vertex.
  SlidingPart(const std::shared_ptr<const geometry::TriangleMesh>& mesh, const Eigen::Vector3d& p_Vref);

  const Eigen::Vector3d& p_Vref() const { return p_Vref_; }
  bool has_chosen_point() const { return has_chosen_point_; }
  /// The radius ρ of the part: the largest distance (metres) of a vertex from the reference point.
  double radius() const { return radius_; }

 private:
  Eigen::Vector3d p_Vref_;
  bool has_chosen_point_;
  double radius_;
};

/// Loads a body from a mesh file (OBJ, STL, PLY, glTF) whose unit is `scale` metres, e.g. 1e-3 for millimetres. The
/// warnings and counts of `geometry::import_mesh` are lost. Call `geometry::import_mesh` to get them. Throws
/// std::invalid_argument, naming the file, as `geometry::import_mesh` does.
GLISSADE_EXPORT std::shared_ptr<const ContactBody> load_body(const std::filesystem::path& file, double scale = 1.0);
/// Like `load_body`, for a part. The compliance point is the centre of the bounding box.
GLISSADE_EXPORT std::shared_ptr<const SlidingPart> load_part(const std::filesystem::path& file, double scale = 1.0);

/// A body that stands still. Several obstacles may share one `ContactBody`.
struct Obstacle {
  std::shared_ptr<const ContactBody> body;
  Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
  std::string name = "an obstacle";  ///< for messages
  /// The gap (metres) at which contacts with this obstacle stop a part. The default is the margin of the part. A
  /// smaller margin allows a tighter fit. A larger margin leaves more clearance. At most kGreatestMargin_m
  /// (`sliding_rules.h`).
  std::optional<double> margin{};
};

/// A motion of several bodies together, the movers of `CertifiedBodies`. The parameter t runs from 0 to 1.
class GLISSADE_EXPORT BodiesMotion {
 public:
  virtual ~BodiesMotion() = default;

  /// Writes the pose X_WM of each mover at t, one entry for each mover.
  virtual void poses(double t, std::span<Eigen::Isometry3d> X_WM) const = 0;
  /// Upper bound (metres) of |x(t) − x(0)| for every point x of a mover and every t.
  virtual double length(std::size_t mover) const = 0;
  /// Upper bound (metres) of |d²x/dt²| for every point x of a mover and every t.
  virtual double acceleration(std::size_t mover) const = 0;
};

}  // namespace glissade::contact
