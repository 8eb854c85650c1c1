// See `register_tick` in benches.h.

#include <array>
#include <chrono>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <glissade/contact/spring.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/haptics/haptic_kernel.h>

#include "benches.h"
#include "held_part.h"

namespace glissade::bench {
namespace {

using Eigen::Vector3d;
using haptics::ContactSet;
using std::chrono::milliseconds;

/// A set of `rows` contacts on the lower side of the part.
ContactSet random_set(int rows) {
  std::mt19937_64 random(static_cast<std::uint64_t>(rows));
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&] { return Vector3d(uniform(random), uniform(random), uniform(random)); };
  ContactSet set;
  set.sequence = 1;
  set.parts[0].hold = 1;
  set.row_count = rows;
  for (int i = 0; i < rows; ++i) {
    const Vector3d n = (0.5 * vector() + Vector3d::UnitZ()).normalized();
    set.row_array[static_cast<std::size_t>(i)] = {{{n, 0.05 * vector(), -1e-5 * (1.0 + uniform(random))}}};
  }
  return set;
}

/// Twelve rows of the parts of two hands among four parts, half of them between the two.
ContactSet set_of_two_hands() {
  ContactSet set = random_set(12);
  set.part_count = 4;
  set.parts[1].hold = 1;
  for (std::size_t i = 0; i < 12; ++i) {
    haptics::ContactRow& row = set.row_array[i];
    row.part = i < 9 ? 0 : 1;
    if (i < 6) row.other = 1;
    row.r_other = row.r;
  }
  return set;
}

devices::GloveState state_at(int tick) {
  devices::GloveState state;
  state.sequence = tick;
  state.time = milliseconds(tick);
  const double phase = 0.01 * tick;
  state.X_WH.translation() = 1e-3 * Vector3d(std::sin(phase), std::cos(phase), -1.0 + 0.3 * std::sin(2.0 * phase));
  return state;
}

haptics::HapticKernel kernel_of(std::size_t parts, std::size_t hands) {
  const auto part = test_support::part_of(geometry::make_box(test_support::kBoxSize, 12));
  const haptics::KernelPart each{part->p_Vref(), part->radius(), contact::stiffness_of_part(part->radius())};
  std::vector<haptics::KernelHand> all_hands;
  for (std::size_t h = 0; h < hands; ++h)
    all_hands.push_back({devices::simulated_glove_descriptor(), h});
  return {std::vector<haptics::KernelPart>(parts, each), all_hands};
}

void run_ticks(benchmark::State& state, std::size_t parts, std::size_t hands, ContactSet set) {
  haptics::HapticKernel kernel = kernel_of(parts, hands);
  std::array<devices::GloveState, 2> states;
  const std::array<const devices::GloveState*, 2> newest{&states[0], &states[1]};
  int tick = 0;
  for (auto _ : state) {
    set.time = milliseconds(tick);
    for (std::size_t h = 0; h < hands; ++h)
      states[h] = state_at(tick + 300 * static_cast<int>(h));
    kernel.tick({newest.data(), hands}, set, milliseconds(tick));
    ++tick;
  }
}

}  // namespace

void register_tick(const BenchOptions& /*options*/) {
  for (const int rows : {0, 12, 64}) {
    benchmark::RegisterBenchmark(("tick/rows-" + std::to_string(rows) + "/glissade").c_str(),
                                 [=](benchmark::State& state) { run_ticks(state, 1, 1, random_set(rows)); });
  }
  benchmark::RegisterBenchmark("tick/rows-12-two-hands/glissade",
                               [](benchmark::State& state) { run_ticks(state, 4, 2, set_of_two_hands()); });
}

}  // namespace glissade::bench
