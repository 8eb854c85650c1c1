// Links the private dependencies of the components contact and collision: TBB and Highway (trees), Qhull (hulls); and
// those of grasping: urdfdom.

#include <fstream>
#include <iostream>
#include <memory>

#include <glissade/contact/sliding.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/grasping/grasp_simulation.h>

int main() {
  using namespace glissade;
  const auto at_height = [](double z) { return Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, z)); };
  std::ofstream("tetrahedron.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  const auto tetrahedron = contact::load_part("tetrahedron.obj", 1.0);
  const auto plate = std::make_shared<contact::ContactBody>(
      std::make_shared<geometry::TriangleMesh>(geometry::make_plate({4.0, 4.0}, 200)));

  contact::Sliding sliding({{plate}}, tetrahedron, at_height(0.001));
  for (int i = 0; i < 100; ++i)
    sliding.advance(at_height(-0.001));
  const double height = sliding.result().X_WV.translation().z();
  const bool right = height > 0.0 && height <= 1.001 * sliding.margin();
  grasping::GraspSimulation simulation({{plate}}, {{.part_V = tetrahedron, .X_WV_start = at_height(0.001)}},
                                       {std::make_shared<const grasping::HandModel>(grasping::make_hand())});
  if (simulation.parts().part_count() != 1) return 1;
  std::cout << (right ? "Contact alone works.\n" : "The part does not lie on the plate.\n");
  return right ? 0 : 1;
}
