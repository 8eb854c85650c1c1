#pragma once

/// The ways the command `collide` can answer: with the DOP-trees, or by brute force to check them.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::apps {

/// What is asked at every pose.
struct CollideQuestion {
  double tolerance = 0.0;    ///< metres, ≥ 0: how far apart triangles may be and still count
  bool count_pairs = false;  ///< otherwise one pair settles a pose
};

/// What is found at one pose.
struct CollideAnswer {
  bool colliding;
  std::int64_t pairs;  ///< pairs of triangles within the tolerance; meaningless unless they were to be counted
};

/// The mesh files next to which trees are kept (`load_or_build_tree.h`); empty: they are not.
struct TreeFiles {
  std::string mesh_A;
  std::string mesh_B;
};

/// Answers for the pose X_AB of mesh B in the frame of mesh A. Keeps scratch memory: one per thread.
using CollideMethod = std::function<CollideAnswer(const Eigen::Isometry3d& X_AB)>;

/// The names that `make_collide_method` knows; the first is the default.
const std::vector<std::string>& collide_method_names();

/// Prepares the method `name` for two meshes. Throws std::invalid_argument for another name and for what `DopTree`
/// refuses.
CollideMethod make_collide_method(const std::string& name, std::shared_ptr<const geometry::TriangleMesh> mesh_A,
                                  std::shared_ptr<const geometry::TriangleMesh> mesh_B, const CollideQuestion& question,
                                  const TreeFiles& files = {});

}  // namespace glissade::apps
