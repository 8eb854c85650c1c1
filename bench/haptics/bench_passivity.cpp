// See `register_passivity` in benches.h.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>
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

void compare_stiffness(benchmark::State& state, const Preset& preset, milliseconds delay) {
  devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  device.max_stiffness = preset.max_stiffness;
  device.damping = damping_for(preset.max_stiffness);
  const double theory = haptics::passive_stiffness(device, haptics::kTickPeriod, delay).translational;
  double simulated = 0.0;
  for (auto _ : state)
    simulated = test_support::stiffness_that_grows(device.damping, delay);
  state.counters["stiffness_N_per_m"] = theory;
  state.counters["simulated_N_per_m"] = simulated;
  state.counters["ratio_to_simulation"] = theory / simulated;
}

void run_random_walls(benchmark::State& state, std::uint64_t settings) {
  test_support::WallEnergies worst;
  for (auto _ : state) {
    for (std::uint64_t seed = 1; seed <= settings; ++seed) {
      const test_support::WallEnergies energies = test_support::random_wall(seed);
      worst.least_J = std::min(worst.least_J, energies.least_J);
      worst.given_J = std::max(worst.given_J, energies.given_J);
    }
  }
  state.counters["settings"] = static_cast<double>(settings);
  state.counters["least_energy_J"] = worst.least_J;
  state.counters["most_given_J"] = worst.given_J;
}

/// The forces of a hand, as stiff and damped as a relaxed arm, that waits above a wall of 1000 N/m until the delay is
/// known, and then wants to be 20 mm deep in it for six seconds; and how deep it is at the end.
std::pair<std::vector<double>, double> press(milliseconds one_way) {
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
  return {forces, -wall.z()};
}

void feel_wall(benchmark::State& state, milliseconds one_way) {
  for (auto _ : state) {
    const auto [forces, depth] = press(one_way);
    const double last = forces.back();
    const auto is_off = [=](double force) { return std::abs(force - last) > 0.02 * last; };
    const auto settled = std::find_if(forces.rbegin(), forces.rend(), is_off);
    const auto [least, greatest] = std::minmax_element(forces.end() - 1000, forces.end());
    state.counters["stiffness_N_per_m"] = last / depth;
    state.counters["force_N"] = last;
    state.counters["overshoot_percent"] = 100.0 * (*std::max_element(forces.begin(), forces.end()) / last - 1.0);
    state.counters["settled_after_ms"] = static_cast<double>(forces.rend() - settled);
    state.counters["unrest_N"] = *greatest - *least;
  }
}

}  // namespace

void register_passivity(const BenchOptions& options) {
  const auto add = [](const std::string& name, const auto& run) {
    register_single_run("passivity/" + name + "/glissade", run);
  };
  for (const Preset& preset : kPresets) {
    for (const int delay_ms : kDelays_ms) {
      add(std::string(preset.name) + "-" + std::to_string(delay_ms) + "ms",
          [=](benchmark::State& state) { compare_stiffness(state, preset, milliseconds(delay_ms)); });
    }
  }
  add("random",
      [settings = options.quick ? 60U : 1000U](benchmark::State& state) { run_random_walls(state, settings); });
  for (const int one_way_ms : {0, 1, 5, 10, 25, 50}) {
    add("wall-" + std::to_string(2 * one_way_ms) + "ms",
        [=](benchmark::State& state) { feel_wall(state, milliseconds(one_way_ms)); });
  }
}

}  // namespace glissade::bench
