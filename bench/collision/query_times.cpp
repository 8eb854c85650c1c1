// Yes-or-no queries in C++, for scripts/bench_python: query_times POSES, a file of matrices X_AB of 16 doubles, row by
// row. For each line `glissade` or `fcl N` on standard input, passes twice over all poses, or over every Nth, and
// prints the seconds of the second pass and the number of intersecting poses. The meshes are a torus and a sphere of
// 50,000 triangles.

#include <chrono>
#include <cstddef>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <fcl/narrowphase/collision.h>

#include <glissade/collision/dop_query.h>
#include <glissade/geometry/mesh_generators.h>

#include "fcl_model.h"
#include "pose_matrices.h"

namespace {

using namespace glissade;

void print_pass(const std::vector<Eigen::Isometry3d>& poses, std::size_t stride, const auto& intersects_at) {
  std::size_t count = 0;
  const auto pass = [&] {
    count = 0;
    for (std::size_t i = 0; i < poses.size(); i += stride)
      count += intersects_at(poses[i]) ? 1 : 0;
  };
  pass();  // caches hold the model of this subject again
  const auto start = std::chrono::steady_clock::now();
  pass();
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  std::cout << time.count() << ' ' << count << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::vector<Eigen::Isometry3d> poses = test_support::read_poses(argv[1]);
  const auto torus = std::make_shared<geometry::TriangleMesh>(geometry::make_torus(0.08, 0.03, 50'000));
  const auto sphere = std::make_shared<geometry::TriangleMesh>(geometry::make_sphere(0.04, 50'000));
  const collision::DopTree tree_A(torus), tree_B(sphere);
  const bench::FclTree fcl_A = bench::fcl_tree(*torus), fcl_B = bench::fcl_tree(*sphere);
  collision::QueryWorkspace workspace;
  const fcl::CollisionRequest<double> request(1);
  fcl::CollisionResult<double> result;

  std::string subject;
  while (std::cin >> subject) {
    if (subject == "glissade") {
      print_pass(poses, 1, [&](const auto& X_AB) { return intersects(tree_A, tree_B, X_AB, workspace); });
    } else {
      std::size_t stride = 1;
      std::cin >> stride;
      print_pass(poses, stride, [&](const auto& X_AB) {
        result.clear();
        return fcl::collide(&fcl_A, Eigen::Isometry3d::Identity(), &fcl_B, X_AB, request, result) > 0;
      });
    }
  }
}
