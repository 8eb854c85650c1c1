#pragma once

/// The methods of the command `collide`: DOP-trees, or brute force as a check.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/query_types.h>
#include <glissade/geometry/triangle_mesh.h>

namespace glissade::apps {

/// The question at every pose.
struct CollideQuestion {
  double tolerance = 0.0;    ///< metres, ≥ 0: triangles at most this far apart collide
  bool count_pairs = false;  ///< without it, the first pair ends the search at a pose
  bool measure = false;      ///< the distance too
};

/// The answer at one pose.
struct CollideAnswer {
  bool colliding;
  std::int64_t pairs;                  ///< pairs of triangles within the tolerance; meaningless without `count_pairs`
  collision::MeshDistance distance{};  ///< meaningless without `measure`
};

/// Mesh files beside which the trees are kept (`load_or_build_tree.h`); with empty paths, trees are not kept.
struct TreeFiles {
  std::string mesh_A;
  std::string mesh_B;
};

/// Answers for the pose X_AB of mesh B in the frame of mesh A. Keeps scratch memory: use one per thread.
using CollideMethod = std::function<CollideAnswer(const Eigen::Isometry3d& X_AB)>;

/// The names that `make_collide_method` knows; the first is the default.
const std::vector<std::string>& collide_method_names();

/// Prepares the method `name` for two meshes. Throws std::invalid_argument for an unknown name and for a mesh that
/// `DopTree` refuses.
CollideMethod make_collide_method(const std::string& name, std::shared_ptr<const geometry::TriangleMesh> mesh_A,
                                  std::shared_ptr<const geometry::TriangleMesh> mesh_B, const CollideQuestion& question,
                                  const TreeFiles& files = {});

}  // namespace glissade::apps
