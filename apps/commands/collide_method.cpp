#include <limits>
#include <stdexcept>
#include <utility>

#include <glissade/apps/commands/collide_method.h>
#include <glissade/apps/commands/load_or_build_tree.h>
#include <glissade/apps/text.h>
#include <glissade/collision/dop_query.h>
#include <glissade/collision/dop_tree.h>
#include <glissade/geometry/triangle_pair.h>
#include <glissade/reference/brute_force.h>

namespace glissade::apps {

namespace {

using collision::DopTree;
using geometry::TriangleMesh;
using geometry::TrianglePoints;

constexpr const char* kDopTree = "dop-tree";
constexpr const char* kBruteForce = "brute-force";

/// The trees of two meshes and the workspace of their queries.
class TreeMethod {
 public:
  TreeMethod(const std::shared_ptr<const geometry::TriangleMesh>& mesh_A,
             const std::shared_ptr<const geometry::TriangleMesh>& mesh_B, const CollideQuestion& question,
             const TreeFiles& files)
      : tree_A_(std::make_shared<const DopTree>(load_or_build_tree(mesh_A, files.mesh_A))),
        tree_B_(std::make_shared<const DopTree>(load_or_build_tree(mesh_B, files.mesh_B))),
        question_(question) {}

  CollideAnswer operator()(const Eigen::Isometry3d& X_AB) {
    CollideAnswer answer = collides(X_AB);
    if (question_.measure) answer.distance = distance(*tree_A_, *tree_B_, X_AB, *workspace_);
    return answer;
  }

 private:
  CollideAnswer collides(const Eigen::Isometry3d& X_AB) {
    if (question_.tolerance > 0.0) {
      pairs_within(*tree_A_, *tree_B_, X_AB, question_.tolerance, *workspace_, close_pairs_);
      return {!close_pairs_.empty(), static_cast<std::int64_t>(close_pairs_.size())};
    }
    if (!question_.count_pairs) return {intersects(*tree_A_, *tree_B_, X_AB, *workspace_), 0};
    intersecting_pairs(*tree_A_, *tree_B_, X_AB, *workspace_, pairs_);
    return {!pairs_.empty(), static_cast<std::int64_t>(pairs_.size())};
  }

  std::shared_ptr<const DopTree> tree_A_;
  std::shared_ptr<const DopTree> tree_B_;
  CollideQuestion question_;
  // Shared, because a std::function must be copyable and a workspace is not.
  std::shared_ptr<collision::QueryWorkspace> workspace_ = std::make_shared<collision::QueryWorkspace>();
  std::vector<collision::TrianglePair> pairs_;
  std::vector<collision::ClosePair> close_pairs_;
};

struct NumberedTriangle {
  std::int32_t number;  ///< in its mesh
  TrianglePoints points;
};

/// The triangles of `mesh` that have an area, with their corners p at X * p.
std::vector<NumberedTriangle> triangles_of(const TriangleMesh& mesh, const Eigen::Isometry3d& X) {
  std::vector<NumberedTriangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(mesh.triangles.size()); ++i) {
    // Degeneracy is decided before the pose is applied, as in the trees.
    if (geometry::is_degenerate(mesh.corners(i))) continue;
    triangles.push_back({i, {X * mesh.corner(i, 0), X * mesh.corner(i, 1), X * mesh.corner(i, 2)}});
  }
  return triangles;
}

/// Every triangle of one mesh against every triangle of the other.
class BruteForceMethod {
 public:
  BruteForceMethod(std::shared_ptr<const geometry::TriangleMesh> mesh_A,
                   std::shared_ptr<const geometry::TriangleMesh> mesh_B, const CollideQuestion& question)
      : mesh_A_(std::move(mesh_A)), mesh_B_(std::move(mesh_B)), question_(question) {}

  CollideAnswer operator()(const Eigen::Isometry3d& X_AB) const {
    CollideAnswer answer = collides(X_AB);
    if (question_.measure) answer.distance = distance(X_AB);
    return answer;
  }

 private:
  CollideAnswer collides(const Eigen::Isometry3d& X_AB) const {
    if (question_.tolerance > 0.0) return within_tolerance(X_AB);
    if (!question_.count_pairs) return {reference::brute_force_intersects(*mesh_A_, *mesh_B_, X_AB), 0};
    const auto pairs = static_cast<std::int64_t>(reference::brute_force_pairs(*mesh_A_, *mesh_B_, X_AB).size());
    return {pairs > 0, pairs};
  }

  CollideAnswer within_tolerance(const Eigen::Isometry3d& X_AB) const {
    const std::vector<NumberedTriangle> triangles_A = triangles_of(*mesh_A_, Eigen::Isometry3d::Identity());
    std::int64_t pairs = 0;
    for (const NumberedTriangle& b : triangles_of(*mesh_B_, X_AB)) {
      for (const NumberedTriangle& a : triangles_A) {
        if (geometry::triangle_distance(a.points, b.points).distance > question_.tolerance) continue;
        if (!question_.count_pairs) return {true, 0};
        ++pairs;
      }
    }
    return {pairs > 0, pairs};
  }

  collision::MeshDistance distance(const Eigen::Isometry3d& X_AB) const {
    collision::MeshDistance least{.distance = std::numeric_limits<double>::infinity(), .nearest = {}};
    const std::vector<NumberedTriangle> triangles_B = triangles_of(*mesh_B_, X_AB);
    for (const NumberedTriangle& a : triangles_of(*mesh_A_, Eigen::Isometry3d::Identity())) {
      for (const NumberedTriangle& b : triangles_B) {
        const geometry::TriangleDistance d = geometry::triangle_distance(a.points, b.points);
        if (d.distance == 0.0) return {.distance = 0.0, .nearest = {}};
        if (d.distance >= least.distance) continue;
        least.distance = d.distance;
        least.nearest = {{a.number, b.number}, d.distance, d.p_a, d.p_b};
      }
    }
    return least;
  }

  std::shared_ptr<const geometry::TriangleMesh> mesh_A_;
  std::shared_ptr<const geometry::TriangleMesh> mesh_B_;
  CollideQuestion question_;
};

}  // namespace

const std::vector<std::string>& collide_method_names() {
  static const std::vector<std::string> names{kDopTree, kBruteForce};
  return names;
}

CollideMethod make_collide_method(const std::string& name, std::shared_ptr<const geometry::TriangleMesh> mesh_A,
                                  std::shared_ptr<const geometry::TriangleMesh> mesh_B, const CollideQuestion& question,
                                  const TreeFiles& files) {
  if (name == kBruteForce) return BruteForceMethod(std::move(mesh_A), std::move(mesh_B), question);
  if (name == kDopTree) return TreeMethod(mesh_A, mesh_B, question, files);
  throw std::invalid_argument("unknown method " + in_quotes(name) + " (known: " + joined(collide_method_names()) + ")");
}

}  // namespace glissade::apps
