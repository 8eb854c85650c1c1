// See `run_passivity` in benches.h.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <glissade/devices/simulated_glove.h>
#include <glissade/haptics/coupling.h>

#include "benches.h"
#include "delayed_wall.h"

namespace glissade::bench {
namespace {

using std::chrono::milliseconds;
using test_support::DelayedWall;

/// A device by its name and the largest stiffness (N/m) that its maker states.
struct Preset {
  const char* name;
  double max_stiffness;
};

constexpr std::array<Preset, 10> kPresets{{{"lambda.7", 8000.0},
                                           {"delta.3", 5000.0},
                                           {"omega.7", 5000.0},
                                           {"sigma.7", 4000.0},
                                           {"Falcon", 3000.0},
                                           {"Premium-3.0", 1000.0},
                                           {"Desktop", 1000.0},
                                           {"Premium-1.5", 800.0},
                                           {"Omni", 700.0},
                                           {"Touch", 400.0}}};
constexpr std::array kDelays_ms{0, 1, 5, 20, 50};

/// Makers do not state the damping of their devices. This is the least with which the stated stiffness is passive.
double damping_for(double max_stiffness) {
  return 0.5e-3 * max_stiffness;
}

void run_limits(Results& results) {
  std::fprintf(stderr, "passivity limits\n");
  for (const Preset& preset : kPresets) {
    devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
    device.max_stiffness = preset.max_stiffness;
    device.damping = damping_for(preset.max_stiffness);
    for (const int delay_ms : kDelays_ms) {
      const milliseconds delay(delay_ms);
      const double theory = haptics::passive_stiffness(device, haptics::kTickPeriod, delay).translational;
      const double simulated = test_support::stiffness_that_grows(device.damping, delay);
      const std::string name = std::string(preset.name) + "-" + std::to_string(delay_ms) + "ms";
      results.add({kPassivity, name, "glissade", "stiffness", theory, "N/m"});
      results.add({kPassivity, name, "simulation", "stiffness", simulated, "N/m"});
      results.add({kPassivity, name, "glissade", "ratio_to_simulation", theory / simulated, "x"});
    }
  }
}

void run_random_walls(bool quick, Results& results) {
  std::fprintf(stderr, "passivity of random walls\n");
  const std::uint64_t settings = quick ? 60 : 1000;
  test_support::WallEnergies worst;
  for (std::uint64_t seed = 1; seed <= settings; ++seed) {
    const test_support::WallEnergies energies = test_support::random_wall(seed);
    worst.least_J = std::min(worst.least_J, energies.least_J);
    worst.given_J = std::max(worst.given_J, energies.given_J);
  }
  results.add({kPassivity, "random", "glissade", "settings", static_cast<double>(settings), "1"});
  results.add({kPassivity, "random", "glissade", "least_energy", worst.least_J, "J"});
  results.add({kPassivity, "random", "glissade", "most_given", worst.given_J, "J"});
}

/// A hand, as stiff and damped as a relaxed arm, waits above a wall of 1000 N/m until the delay is known, and then
/// wants to be 20 mm deep in it.
void run_feel(milliseconds one_way, Results& results) {
  constexpr double kArm_N_per_m = 400.0;
  constexpr double kArm_N_s_per_m = 20.0;
  DelayedWall wall(devices::simulated_glove_descriptor(), 0.8, 1000.0, one_way, kArm_N_s_per_m);
  const auto lead_to = [&](double z) { wall.step(-kArm_N_per_m * (wall.z() - z)); };
  for (int i = 0; i < 2000; ++i)
    lead_to(5e-3);
  std::vector<double> forces;
  for (int i = 0; i < 6000; ++i) {
    lead_to(-0.02);
    forces.push_back(wall.force());
  }
  const double last = forces.back();
  const auto is_off = [=](double force) { return std::abs(force - last) > 0.02 * last; };
  const auto settled = std::find_if(forces.rbegin(), forces.rend(), is_off);
  const auto [least, greatest] = std::minmax_element(forces.end() - 1000, forces.end());
  const std::string name = "wall-" + std::to_string(2 * one_way.count()) + "ms";
  const auto add = [&](const std::string& metric, double value, const std::string& unit) {
    results.add({kPassivity, name, "glissade", metric, value, unit});
  };
  add("stiffness", last / -wall.z(), "N/m");
  add("force", last, "N");
  add("overshoot", 100.0 * (*std::max_element(forces.begin(), forces.end()) / last - 1.0), "%");
  add("settled_after", static_cast<double>(forces.rend() - settled), "ms");
  add("unrest", *greatest - *least, "N");
}

}  // namespace

void run_passivity(const SlidingBenchOptions& options, Results& results) {
  run_limits(results);
  run_random_walls(options.quick, results);
  std::fprintf(stderr, "walls behind a delay\n");
  for (const int one_way_ms : {0, 1, 5, 10, 25, 50})
    run_feel(milliseconds(one_way_ms), results);
}

}  // namespace glissade::bench
