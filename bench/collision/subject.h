#pragma once

/// The subjects of the benches: Glissade, its variants, and other libraries. Small adapters give them one interface.

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/dop_query.h>

namespace glissade::bench {

/// The model that a library has built of a mesh, with its own copy of the data that it needs.
class Model {
 public:
  virtual ~Model() = default;
};

/// Queries of one pair of models.
class Query {
 public:
  virtual ~Query() = default;

  /// Applies global settings. Called before passes over the poses, and not measured.
  virtual void prepare() {}
  /// Clears memory of earlier queries. Called before each pass.
  virtual void forget() {}
  /// X_AB is the pose of B in the frame of A.
  virtual bool intersects(const Eigen::Isometry3d& X_AB) = 0;
  /// Number of intersecting pairs of triangles. The library must identify the pairs.
  virtual std::int64_t count_pairs(const Eigen::Isometry3d& X_AB) = 0;
  /// Distance of the meshes, at most 0 if they intersect; only of libraries that know it.
  virtual double distance(const Eigen::Isometry3d& /*X_AB*/) { return std::numeric_limits<double>::quiet_NaN(); }
  /// Work of the last query, for subjects that count it.
  virtual std::optional<collision::QueryCounters> counters() const { return std::nullopt; }
};

struct Subject {
  std::string name;
  std::string model;  ///< subjects with the same `model` share the models built
  std::function<std::unique_ptr<Model>(const geometry::TriangleMesh&)> build;
  std::function<std::unique_ptr<Query>(const Model& model_A, const Model& model_B)> query;
};

/// Glissade with default options; all ratios refer to its time.
Subject glissade_subject();
/// The same with a workspace that remembers the last query.
Subject glissade_coherent();
/// The same on the other instruction sets of this machine: `glissade-avx2`.
std::vector<Subject> glissade_instruction_sets();
/// Pure DOP-trees as in the founding paper, without the extra slab: `glissade-no-slab`, and `glissade-brute-force` with
/// its O(k²) realignment.
std::vector<Subject> glissade_as_published();
/// Other numbers of directions, with and without the extra slab: `glissade-k6`, `glissade-k6-no-slab`.
std::vector<Subject> glissade_directions();

Subject fcl_subject();
Subject ode_subject();
Subject bullet_subject();
Subject cgal_subject();
/// The published method of PQP in our own implementation; not among the other libraries.
Subject pqp_subject();

}  // namespace glissade::bench
