#pragma once

/// A tree of rigid segments joined by hinges, such as a hand, a gripper or an arm. The chain computes the poses of the
/// segments for given joint angles. It also finds the segments that an angle moves, and bounds of their motion. A chain
/// can be read from a URDF file, the format of robot descriptions in ROS.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <glissade/base/export.h>
#include <glissade/geometry/triangle_mesh.h>

namespace glissade::grasping {

/// A flex value of the founding paper (§4), i.e. a number in radians that sets joint angles. It has limits.
struct FlexValue {
  std::string name;
  double lower = 0.0;
  double upper = 0.0;
};

/// A term of a joint's angle: `factor` times the flex value with the number `value`.
struct JointTerm {
  std::size_t value = 0;
  double factor = 1.0;
};

/// A segment, and the joint that connects it to its parent. Frames: P parent link, J joint, L link. At angle 0, L = J.
/// A positive angle turns L about `axis_J` by the right-hand rule. A joint with two degrees of freedom consists of two
/// links at the same place. The first of these links has no mesh.
struct ChainLink {
  std::string name;
  std::optional<std::size_t> parent;  ///< number, lower than that of the link; none for the root (link 0, frame R)
  Eigen::Isometry3d X_PJ = Eigen::Isometry3d::Identity();
  Eigen::Vector3d axis_J = Eigen::Vector3d::UnitX();   ///< of unit length
  double offset = 0.0;                                 ///< rad
  std::vector<JointTerm> terms;                        ///< angle = offset + sum of the terms; empty: a fixed joint
  std::shared_ptr<const geometry::TriangleMesh> mesh;  ///< in L, in metres; null for a link without a surface
};

/// The posture of a chain, i.e. the pose of its root and its flex values; (M, F) in the paper.
struct Posture {
  Eigen::Isometry3d X_WR = Eigen::Isometry3d::Identity();
  std::vector<double> values;  ///< rad, one for each flex value
};

/// Immutable after construction, so threads may share it. All functions but the constructor are real-time safe: they
/// neither allocate nor wait.
class GLISSADE_EXPORT KinematicChain {
 public:
  /// Throws std::invalid_argument, naming the link or the flex value, in these cases: there are no links; a name is
  /// empty or occurs twice; a number is not finite; a lower limit exceeds the upper limit; a parent does not come
  /// before its child; the root has a joint; an X_PJ is no rigid pose; an axis is not of unit length (to 1e-6); a term
  /// has a value that does not exist; or a mesh has no vertices. Cost O(links · (links + values) + vertices).
  KinematicChain(std::vector<FlexValue> values, std::vector<ChainLink> links);

  std::span<const FlexValue> values() const& noexcept { return values_; }
  std::span<const ChainLink> links() const& noexcept { return links_; }
  std::span<const FlexValue> values() const&& = delete;  // of a chain that ends with the expression
  std::span<const ChainLink> links() const&& = delete;

  /// Computes the poses X_WL of all links, for the root at X_WR and flex values in rad. Values may lie beyond the
  /// limits. `values` must have one entry for each flex value, and `X_WL` one entry for each link. Cost O(links), about
  /// 50 ns a link that moves.
  void poses(const Eigen::Isometry3d& X_WR, std::span<const double> values,
             std::span<Eigen::Isometry3d> X_WL) const noexcept;

  /// Adds one row of the Jacobian to `rates`, with the links at X_WL and the root at rest. The row has, for each flex
  /// value, the motion (m/rad) of the point `p_W` of `link` along the unit vector `n_W`. `rates` has an entry for each
  /// flex value. Entries of values that do not move the link stay the same. Cost O(joints between the root and the
  /// link).
  void add_rates(std::size_t link, const Eigen::Vector3d& p_W, const Eigen::Vector3d& n_W,
                 std::span<const Eigen::Isometry3d> X_WL, std::span<double> rates) const noexcept;

  /// Whether the pose of a link in R depends on a flex value. O(1).
  bool moves(std::size_t value, std::size_t link) const noexcept;

  /// Whether `descendant` is `link` itself or hangs on it, directly or through other links. O(1).
  bool hangs_on(std::size_t descendant, std::size_t link) const noexcept;

  /// An upper bound, for any flex values, of the distance (m) of the mesh points of `link` from the origin of the frame
  /// of the link `joint`. If this joint turns by an angle a, no point of `link` moves farther than 2 sin(a/2) · reach.
  /// The bound is 0 for a link without a mesh. `hangs_on(link, joint)` must hold. O(1).
  double reach(std::size_t link, std::size_t joint) const noexcept;

  /// Moves each value that is beyond a limit to this limit.
  void clamp(std::span<double> values) const noexcept;

 private:
  void find_dependencies();
  void find_reaches();
  std::size_t pair(std::size_t link, std::size_t other) const noexcept { return link * links_.size() + other; }

  std::vector<FlexValue> values_;
  std::vector<ChainLink> links_;
  std::vector<Eigen::Isometry3d> X_PJ_;  ///< by link; for a fixed joint, X_PL
  std::vector<char> moves_;              ///< by link and value
  std::vector<char> hangs_on_;           ///< by link and other link
  std::vector<double> reach_;            ///< by link and joint
};

/// A chain, and warnings about skipped or missing content of its mesh files. Each warning is the name of the file,
/// followed by a sentence of `ImportedMesh::warnings`. No warning occurs twice.
struct UrdfChain {
  KinematicChain chain;
  std::vector<std::string> warnings;
};

/// Reads a robot as a chain. The root of the chain is the root link of the file. Each link comes before the links that
/// hang on it.
///
/// - Joints: `revolute` with its limits, `continuous` with limits of ±π, and `fixed`. Every `revolute` or `continuous`
///   joint without `<mimic>` gives a flex value with the name of the joint, in the order of the links.
/// - `<mimic>`: the joint turns with the value of the joint that it mimics, directly or through other mimics. Limits of
///   a joint with `<mimic>` are not used.
/// - Meshes: the collision geometry of a link, as one mesh. Boxes, cylinders and spheres become triangles. Mesh files
///   are read by `geometry::import_mesh`, with `scale`. The path of a mesh file is absolute, relative to the folder of
///   the URDF file, `file://`, or `package://NAME/PATH`. The folder of a package is the nearest folder NAME that
///   contains the URDF file, or whose parent folder contains this file.
///
/// Visual geometry, masses, dynamics and transmissions are ignored.
///
/// Throws std::invalid_argument, naming the file and the link or joint, in these cases: the file is missing or not well
/// formed; a joint is prismatic, floating or planar; the links do not form one tree; a limit, axis, size or scale is
/// invalid; a joint mimics a missing or fixed joint, or mimic joints form a cycle; or a mesh file cannot be found or
/// imported. May block on the disk.
GLISSADE_EXPORT UrdfChain read_urdf(const std::filesystem::path& path);

}  // namespace glissade::grasping
