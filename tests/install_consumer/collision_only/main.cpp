// Links the private dependencies of the component collision: TBB and Highway (trees), Qhull (hulls).

#include <fstream>
#include <iostream>
#include <memory>

#include <glissade/collision/convex_hull.h>
#include <glissade/collision/dop_query.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/mesh_import.h>

int main() {
  using namespace glissade;
  std::ofstream("tetrahedron.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  const auto tetrahedron = std::make_shared<geometry::TriangleMesh>(geometry::import_mesh("tetrahedron.obj").mesh);
  const auto box = std::make_shared<geometry::TriangleMesh>(geometry::make_box({1.0, 1.0, 1.0}, 300));
  const collision::DopTree tree_A(tetrahedron);
  const collision::DopTree tree_B(box);

  // The box reaches from x - 0.5 on, the tetrahedron to 1.
  const auto intersect_at = [&](double x) {
    collision::QueryWorkspace workspace;
    return collision::intersects(tree_A, tree_B, Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, 0.0)), workspace);
  };
  const bool right =
      intersect_at(1.49) && !intersect_at(1.51) && collision::ConvexHull(*tetrahedron).vertices().size() == 4;
  std::cout << (right ? "Collision alone works.\n" : "A query answers wrongly.\n");
  return right ? 0 : 1;
}
