// A hand closes round a ball, lifts it and lets go. Nothing but the angles of its joints says so.
#include <array>
#include <iostream>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/simulation/simulation.h>

int main() {
  using namespace glissade;
  const Eigen::Isometry3d X_WTable(Eigen::Translation3d(0.1, 0.0, -0.102));
  const Eigen::Isometry3d X_WBall(Eigen::Translation3d(0.095, 0.0, -0.056));  // before the palm, just above the table
  simulation::Simulation simulation({.objects = {{"table", geometry::make_box({0.6, 0.6, 0.02}, 200), X_WTable},
                                                 {"ball", geometry::make_sphere(0.035, 2000), X_WBall, true}},
                                     .hands = {grasping::HandShape{}}});
  grasping::Posture posture{.values = std::vector<double>(hands::kJoints, 0.0)};  // the root at the origin, open
  for (int ms = 0; ms < 1500; ++ms) {
    for (const std::size_t joint : {0u, 1u, 4u, 5u, 7u, 8u, 11u, 12u, 15u, 16u})  // of `hands::kJointNames`
      posture.values[joint] = 1.2 * (ms < 1100 ? std::min(1.0, ms / 300.0) : std::max(0.0, (1400 - ms) / 300.0));
    posture.X_WR.translation().z() = 0.2 * std::clamp((ms - 500) / 500.0, 0.0, 1.0);
    simulation.advance(std::array{std::optional(posture)});
    if (ms % 500 == 499) std::cout << reason_of(simulation.engine().grasp(0)) << '\n';
  }
  std::cout << "The ball has come up by " << (simulation.X_WV(0) * X_WBall.inverse()).translation().z() * 1e3
            << " mm\n";
}
