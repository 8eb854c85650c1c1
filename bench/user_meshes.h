#pragma once

/// The meshes and pairs of meshes that a user gives to the benchmarks.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::bench {

struct UserMesh {
  std::string name;                                    ///< the file's stem
  std::shared_ptr<const geometry::TriangleMesh> mesh;  ///< as in the file
};

/// The meshes of all files, in the order of their paths within a folder: a folder stands for all OBJ, STL and PLY files
/// below it. Throws std::invalid_argument for a file that cannot be used, and for two of one name.
std::vector<UserMesh> user_meshes(const std::vector<std::filesystem::path>& files);

struct UserPair {
  UserMesh mesh_A;
  UserMesh mesh_B;
  std::optional<double> metres_per_unit = {};  ///< of both files
  /// Where B begins to move, not turned: its origin in the frame of A, in units of the files.
  std::optional<Eigen::Vector3d> p_AB = {};
};

/// The pairs in a file, one a line: the names of two meshes; metres per unit may follow, and then the three coordinates
/// of `p_AB`. Throws std::invalid_argument, naming file and line, for a file that cannot be read, for any other line,
/// and for a name that none of the meshes has.
std::vector<UserPair> user_pairs(const std::filesystem::path& list, const std::vector<UserMesh>& meshes);

/// The mesh centred on the origin and scaled by `scale`.
geometry::TriangleMesh centered(geometry::TriangleMesh mesh, double scale);

/// Centre of the bounding box.
Eigen::Vector3d center_of(const geometry::TriangleMesh& mesh);

/// Largest extent of the mesh along an axis.
double largest_extent(const geometry::TriangleMesh& mesh);

}  // namespace glissade::bench
