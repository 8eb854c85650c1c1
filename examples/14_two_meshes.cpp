// Two meshes: whether they intersect, how far they are apart and where, and a way out of an overlap.
#include <iostream>
#include <memory>

#include <glissade/collision/dop_query.h>
#include <glissade/geometry/mesh_generators.h>

int main() {
  using namespace glissade;
  const auto box = std::make_shared<const geometry::TriangleMesh>(geometry::make_box({0.1, 0.06, 0.04}, 1200));
  const collision::DopTree tree_A(box);  // a pointer to the mesh of either, or of both
  const collision::DopTree tree_B(box);
  collision::QueryWorkspace workspace;  // one for each thread

  const Eigen::Isometry3d X_AB(Eigen::Translation3d(0.0, 0.0, 0.05));  // the pose of B in A: 50 mm higher
  const collision::MeshDistance apart = collision::distance(tree_A, tree_B, X_AB, workspace);
  std::cout << std::boolalpha << "intersect: " << collision::intersects(tree_A, tree_B, X_AB, workspace) << '\n';
  std::cout << "distance: " << apart.distance * 1e3 << " mm, at " << apart.nearest->p_A.transpose() << " m\n";

  const Eigen::Isometry3d X_AB_overlap(Eigen::Translation3d(0.0, 0.0, 0.037));
  const collision::Penetration out = collision::find_way_out(tree_A, tree_B, X_AB_overlap, workspace);
  std::cout << "way out: " << out.depth() * 1e3 << " mm\n";
}
