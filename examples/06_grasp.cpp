// A hand closes round a ball, lifts it and lets go. Nothing but the angles of its joints says so.

#include <algorithm>
#include <array>
#include <iostream>
#include <memory>
#include <optional>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/grasping/grasp_simulation.h>

int main() {
  using namespace glissade;
  const auto at = [](double x, double y, double z) { return Eigen::Isometry3d(Eigen::Translation3d(x, y, z)); };
  const auto mesh = [](const geometry::TriangleMesh& m) { return std::make_shared<geometry::TriangleMesh>(m); };
  const auto ball_V = std::make_shared<contact::SlidingPart>(mesh(geometry::make_sphere(0.035, 2000)));
  const auto table = std::make_shared<contact::ContactBody>(mesh(geometry::make_box({0.6, 0.6, 0.02}, 200)));
  const auto hand = std::make_shared<const grasping::HandModel>(grasping::make_hand());

  // The ball lies before the palm of a hand with its root at the origin, and just above a table.
  grasping::GraspSimulation simulation({{table, at(0.1, 0.0, -0.102), "table"}},
                                       {{.part_V = ball_V, .X_WV_start = at(0.095, 0.0, -0.056)}}, {hand});
  const auto hand_at = [&](double z, double bend) {
    grasping::Posture posture{at(0.0, 0.0, z), {}};
    for (const grasping::FlexValue& value : hand->chain.values()) {
      const bool bends = value.name.ends_with("_mcp") || value.name.ends_with("_pip") || value.name == "thumb_roll";
      posture.values.push_back(bends ? bend : 0.0);
    }
    return posture;
  };
  auto last = devices::HandActivity::kNone;
  for (int ms = 0; ms < 1500; ++ms) {
    const double close = std::clamp(ms / 300.0, 0.0, 1.0) - std::clamp((ms - 1100) / 300.0, 0.0, 1.0);
    const double lift = 0.2 * std::clamp((ms - 500) / 500.0, 0.0, 1.0);
    simulation.advance(std::array{std::optional(hand_at(lift, 1.2 * close))});
    const devices::HandActivity now = simulation.activity(0);
    if (now != last) std::cout << ms << " ms: " << name_of(now) << "; " << reason_of(simulation.grasp(0)) << "\n";
    last = now;
  }
  std::cout << "The ball has come up by " << (simulation.parts().result(0).X_WV.translation().z() + 0.056) * 1e3
            << " mm, and stays there.\n";
}
