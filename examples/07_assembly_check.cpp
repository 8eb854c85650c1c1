// Checks an assembly: a part of one STL file slides along a path of 100 mm past that of another, both in millimetres.
#include <iostream>

#include <glissade/simulation/least_clearance.h>

int main(int argc, char** argv) try {
  using namespace glissade;
  if (argc != 3) throw std::invalid_argument("the arguments are the STL files of a fixed and of a moving part");
  simulation::Simulation simulation({.objects = {{.name = "fixed", .mesh = {argv[1], 1e-3}},
                                                 {.name = "moving", .mesh = {argv[2], 1e-3}, .movable = true}}});
  simulation::LeastClearance clearance(simulation.bodies());
  clearance.note(simulation);
  for (int ms = 1; ms <= 1000; ++ms) {
    simulation.advance(Eigen::Isometry3d(Eigen::Translation3d(1e-4 * ms, 0.0, 0.0)));
    clearance.note(simulation);
  }
  for (const contact::TrackedContact& touch : simulation.contacts(0))
    std::cout << "touches '" << simulation.name_of_body(touch.contact.obstacle) << "' at "
              << touch.contact.p_W.transpose() << " m, " << touch.contact.force << " N\n";
  clearance.finish();
  std::cout << "least clearance " << clearance.least() * 1e3 << " mm after " << clearance.least_at() << " ms, "
            << simulation.lag(0).v.norm() * 1e3 << " mm from the goal\n";
} catch (const std::exception& error) {
  std::cerr << "assembly_check: " << error.what() << '\n';
  return 1;
}
