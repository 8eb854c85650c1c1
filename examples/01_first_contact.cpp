#include <iostream>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/simulation/simulation.h>

int main() {
  using namespace glissade;
  const Eigen::Isometry3d X_WB(Eigen::Translation3d(0.0, 0.0, 0.030));  // 10 mm above the plate
  const Eigen::Isometry3d X_WG(Eigen::Translation3d(0.1, 0.0, 0.017));  // where the hand goes: 3 mm too deep
  simulation::Simulation simulation({.objects = {{"plate", geometry::make_plate({0.4, 0.4}, 200)},
                                                 {"box", geometry::make_box({0.1, 0.06, 0.04}, 1200), X_WB, true}}});
  for (int millisecond = 0; millisecond < 1000; ++millisecond)
    simulation.advance(X_WG);
  std::cout << "The box lies at z = " << simulation.X_WV(0).translation().z() * 1e3 << " mm, and the hand feels "
            << simulation.wrench(0).f.z() << " N upwards.\n";
}
