// Compares the collision verdicts of Glissade's DOP-tree with those of FCL on two meshes, at poses half of which are
// within 1e-3 of the size of a contact. For each difference it prints the exact verdict (brute force in exact
// arithmetic, and CGAL) and the depth or the gap, which show whose error it is.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fcl/narrowphase/collision.h>

#include <glissade/collision/dop_query.h>
#include <glissade/geometry/mesh_import.h>
#include <glissade/reference/brute_force.h>

#include "cgal_oracle.h"
#include "fcl_model.h"
#include "triangle_points.h"

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
namespace geometry = glissade::geometry;
using namespace glissade::collision;
using glissade::bench::fcl_tree;
using glissade::bench::FclTree;
using glissade::test_support::points_of;

struct Arguments {
  std::filesystem::path path_A;
  std::filesystem::path path_B;
  int poses = 1000;
  std::uint64_t seed = 1;
  double scale_A = 1.0;
  double scale_B = 1.0;
};

bool fcl_intersects(const FclTree& model_A, const FclTree& model_B, const Isometry3d& X_AB) {
  const fcl::CollisionRequest<double> request;
  fcl::CollisionResult<double> result;
  return fcl::collide(&model_A, Isometry3d::Identity(), &model_B, X_AB, request, result) > 0;
}

// Random poses of B: alternately near a contact and anywhere within reach.
class PoseSource {
 public:
  PoseSource(const DopTree& tree_A, const DopTree& tree_B, std::uint64_t seed)
      : tree_A_(tree_A), tree_B_(tree_B), random_(seed) {}

  double size() const { return tree_A_.radius() + tree_B_.radius(); }

  std::vector<Isometry3d> next(int count) {
    std::vector<Isometry3d> poses;
    while (static_cast<int>(poses.size()) < count) {
      append_near_contact(poses);
      poses.push_back(pose_at(random_rotation(), uniform(0.0, 0.8) * size() * random_direction()));
    }
    poses.resize(static_cast<std::size_t>(count));
    return poses;
  }

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  Vector3d random_direction() {
    std::normal_distribution<double> normal;
    const double x = normal(random_);
    const double y = normal(random_);
    return Vector3d(x, y, normal(random_)).normalized();
  }

  Eigen::Matrix3d random_rotation() {
    const Vector3d axis = random_direction();
    return Eigen::AngleAxisd(uniform(-std::numbers::pi, std::numbers::pi), axis).toRotationMatrix();
  }

  // The centre of B at `p_A` from the centre of A.
  Isometry3d pose_at(const Eigen::Matrix3d& R_AB, const Vector3d& p_A) const {
    Isometry3d X_AB = Isometry3d::Identity();
    X_AB.linear() = R_AB;
    X_AB.translation() = tree_A_.center() + p_A - R_AB * tree_B_.center();
    return X_AB;
  }

  // Approaches a point of A from afar until it collides, bisects, and moves away from the contact by up to 1e-3.
  void append_near_contact(std::vector<Isometry3d>& poses) {
    const Eigen::Matrix3d R_AB = random_rotation();
    const Vector3d direction = random_direction();
    const Vector3d target = uniform(0.0, 0.6) * tree_A_.radius() * random_direction();
    const auto collides_at = [&](double t) {
      return intersects(tree_A_, tree_B_, pose_at(R_AB, target + t * direction), workspace_);
    };
    double free = 2.0 * size();
    double colliding = free;
    while (!collides_at(colliding)) {
      free = colliding;
      colliding -= 0.02 * size();
      if (colliding < 0.0) return;
    }
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (free + colliding);
      (collides_at(middle) ? colliding : free) = middle;
    }
    const double offset = std::pow(10.0, uniform(-12.0, -3.0)) * size();
    const double t = colliding + (uniform(-1.0, 1.0) < 0.0 ? -offset : offset);
    poses.push_back(pose_at(R_AB, target + t * direction));
  }

  const DopTree& tree_A_;
  const DopTree& tree_B_;
  std::mt19937_64 random_;
  QueryWorkspace workspace_;
};

// Distance by which a triangle reaches beyond the plane of another one, on the side with the smaller distance.
double depth_beyond_plane(const geometry::TrianglePoints& triangle, const geometry::TrianglePoints& plane) {
  const Vector3d normal = (plane[1] - plane[0]).cross(plane[2] - plane[0]).normalized();
  double above = 0.0;
  double below = 0.0;
  for (const Vector3d& corner : triangle) {
    const double height = normal.dot(corner - plane[0]);
    above = std::max(above, height);
    below = std::max(below, -height);
  }
  return std::min(above, below);
}

void explain_collision(const DopTree& tree_A, const DopTree& tree_B, const Isometry3d& X_AB,
                       const std::vector<TrianglePair>& pairs) {
  std::size_t confirmed = 0;
  double depth = 0.0;
  for (const TrianglePair& pair : pairs) {
    const geometry::TrianglePoints a = points_of(tree_A.mesh(), pair.triangle_A);
    const geometry::TrianglePoints b = points_of(tree_B.mesh(), pair.triangle_B, X_AB);
    if (glissade::test_support::cgal_intersect(a, b)) ++confirmed;
    depth = std::max(depth, std::min(depth_beyond_plane(a, b), depth_beyond_plane(b, a)));
  }
  std::printf("  exactly: %zu pairs intersect (CGAL confirms %zu), the deepest reaches %.3g m through the other\n",
              pairs.size(), confirmed, depth);
}

void explain_gap(const DopTree& tree_A, const DopTree& tree_B, const Isometry3d& X_AB, double size) {
  QueryWorkspace workspace;
  std::vector<ClosePair> pairs;
  double distance = 1e-15 * size;
  while (pairs.empty() && distance < size) {
    distance *= 10.0;
    pairs_within(tree_A, tree_B, X_AB, distance, workspace, pairs);
  }
  for (const ClosePair& pair : pairs)
    distance = std::min(distance, pair.distance);
  std::printf("  exactly: no pair intersects, the gap is %.3g m\n", distance);
}

void explain(const DopTree& tree_A, const DopTree& tree_B, const Isometry3d& X_AB, double size) {
  const std::vector<TrianglePair> pairs = glissade::reference::brute_force_pairs(tree_A.mesh(), tree_B.mesh(), X_AB);
  if (pairs.empty()) {
    explain_gap(tree_A, tree_B, X_AB, size);
  } else {
    explain_collision(tree_A, tree_B, X_AB, pairs);
  }
}

void compare(const Arguments& arguments) {
  const auto load = [](const std::filesystem::path& path, double scale) {
    return std::make_shared<const geometry::TriangleMesh>(geometry::import_mesh(path, scale).mesh);
  };
  const DopTree tree_A(load(arguments.path_A, arguments.scale_A));
  const DopTree tree_B(load(arguments.path_B, arguments.scale_B));
  const FclTree model_A = fcl_tree(tree_A.mesh());
  const FclTree model_B = fcl_tree(tree_B.mesh());
  PoseSource source(tree_A, tree_B, arguments.seed);
  QueryWorkspace workspace;
  int pose = 0;
  int colliding = 0;
  int differences = 0;
  for (const Isometry3d& X_AB : source.next(arguments.poses)) {
    const bool ours = intersects(tree_A, tree_B, X_AB, workspace);
    const bool theirs = fcl_intersects(model_A, model_B, X_AB);
    colliding += ours ? 1 : 0;
    if (ours != theirs) {
      ++differences;
      std::printf("pose %d: glissade %s, fcl %s\n", pose, ours ? "collides" : "free", theirs ? "collides" : "free");
      explain(tree_A, tree_B, X_AB, source.size());
    }
    ++pose;
  }
  std::printf("poses %d, colliding %d, differences %d, seed %llu, size %.6g m\n", arguments.poses, colliding,
              differences, static_cast<unsigned long long>(arguments.seed), source.size());
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app{"Compares collision verdicts with those of FCL"};
  app.add_option("A", arguments.path_A, "Mesh A, fixed")->required();
  app.add_option("B", arguments.path_B, "Mesh B, moved")->required();
  app.add_option("--poses", arguments.poses, "Number of poses, half of them near contact")->check(CLI::PositiveNumber);
  app.add_option("--seed", arguments.seed, "Seed of the poses");
  app.add_option("--scale-a", arguments.scale_A, "Metres per unit of A");
  app.add_option("--scale-b", arguments.scale_B, "Metres per unit of B");
  CLI11_PARSE(app, argc, argv);
  try {
    compare(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
