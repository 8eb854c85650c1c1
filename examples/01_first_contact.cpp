#include <iostream>
#include <memory>
#include <vector>

#include <glissade/collision/dop_query.h>
#include <glissade/contact/sliding.h>
#include <glissade/contact/spring.h>
#include <glissade/geometry/mesh_generators.h>

int main() {
  using namespace glissade;
  const auto mesh = [](const geometry::TriangleMesh& m) { return std::make_shared<geometry::TriangleMesh>(m); };
  const auto plate_W = std::make_shared<contact::ContactBody>(mesh(geometry::make_plate({0.4, 0.4}, 200)));
  const auto box_V = std::make_shared<contact::SlidingPart>(mesh(geometry::make_box({0.1, 0.06, 0.04}, 1200)));

  const Eigen::Isometry3d X_WV_start(Eigen::Translation3d(0.0, 0.0, 0.030));  // 10 mm above the plate
  const Eigen::Isometry3d X_WG(Eigen::Translation3d(0.1, 0.0, 0.017));        // where the hand goes: 3 mm too deep
  collision::QueryWorkspace workspace;
  std::vector<collision::TrianglePair> pairs;
  collision::intersecting_pairs(plate_W->tree, box_V->tree, X_WG, workspace, pairs);
  std::cout << "The hand's pose is inside the plate: " << pairs.size() << " pairs of triangles intersect.\n";

  contact::Sliding sliding({{plate_W}}, box_V, X_WV_start);
  for (int millisecond = 0; millisecond < 1000; ++millisecond)
    sliding.advance(X_WG);
  const geometry::Displacement lag = geometry::displacement_between(sliding.result().X_WV, X_WG, box_V->p_Vref());
  const contact::Wrench wrench = contact::spring_wrench(sliding.stiffness(), lag);
  std::cout << "The box lies on it at z = " << sliding.result().X_WV.translation().z() * 1e3 << " mm, "
            << "and the hand feels " << wrench.f.z() << " N upwards.\n";
}
