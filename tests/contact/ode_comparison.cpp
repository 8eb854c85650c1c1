// Prints the table of docs/ode_comparison.md: where held primitives come to rest, compared with ODE.

#include <cstdio>
#include <numbers>

#include "ode_scenes.h"

int main() {
  std::printf("| scene | force, torque | position | rotation | force | steps of ODE |\n|---|---|---|---|---|---|\n");
  bool all_at_rest = true;
  for (const auto& scene : glissade::test_support::ode_scenes()) {
    const auto comparison = glissade::test_support::compare_with_ode(scene);
    all_at_rest = all_at_rest && comparison.at_rest;
    const double millidegrees = comparison.difference.w.norm() * 180e3 / std::numbers::pi;
    std::printf("| %s | %.2f N, %.3f Nm | %.4f µm | %.4f m° | %.5f %% | %d |\n", scene.name.c_str(), comparison.force,
                comparison.torque, 1e6 * comparison.difference.v.norm(), millidegrees,
                100.0 * comparison.force_difference, comparison.ode_steps);
  }
  return all_at_rest ? 0 : 1;
}
