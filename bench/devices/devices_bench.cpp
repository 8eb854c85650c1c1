/// The safety envelope before a device (`devices::SafetyEnvelope`).

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include <glissade/devices/safety_envelope.h>
#include <glissade/devices/simulated_glove.h>

#include "bench_program.h"

namespace glissade::bench {
namespace {

using devices::DeviceDescriptor;
using devices::GloveCommand;
using devices::GloveState;
using devices::LimitReasons;
using Eigen::Vector3d;
using std::chrono::milliseconds;

constexpr int kSwing_ms = 400;

/// Along x: to and fro at 0.5 m/s.
double swing_m_per_s(int ms) {
  return ms % kSwing_ms < kSwing_ms / 2 ? 0.5 : -0.5;
}

/// A hand, what is asked of its device, and the limit that this runs into.
struct EnvelopeCase {
  const char* name;
  bool LimitReasons::*limit;  ///< null: none
  std::function<void(DeviceDescriptor&)> change;
  std::function<double(int ms)> speed_x;  ///< of the hand, m/s
  std::function<void(GloveCommand&, int ms)> want;
};

void no_change(DeviceDescriptor& /*device*/) {}

double gently(int ms) {
  return 3e-3 * std::cos(0.01 * ms);
}

std::vector<EnvelopeCase> envelope_cases() {
  const auto pull = [](double newtons) {
    return [=](GloveCommand& wanted, int /*ms*/) { wanted.f_H_W.x() = newtons; };
  };
  return {
      {"calm", nullptr, no_change, gently, pull(10.0)},
      {"force", &LimitReasons::force_limited, no_change, gently, pull(100.0)},
      {"torque", &LimitReasons::torque_limited, no_change, gently,
       [](GloveCommand& wanted, int /*ms*/) { wanted.t_H_W.y() = 2.0; }},
      {"joints", &LimitReasons::joints_limited, no_change, gently,
       [](GloveCommand& wanted, int /*ms*/) { wanted.joint_torques.fill(0.6); }},
      {"rate", &LimitReasons::rate_limited, no_change, gently,
       [](GloveCommand& wanted, int ms) { wanted.f_H_W.x() = ms % 2 == 0 ? 10.0 : -10.0; }},
      {"power", &LimitReasons::power_limited, [](DeviceDescriptor& device) { device.max_power = 5.0; }, swing_m_per_s,
       pull(-20.0)},
      {"mean", &LimitReasons::mean_limited, [](DeviceDescriptor& device) { device.max_mean_force = 8.0; }, gently,
       pull(20.0)},
      {"energy", &LimitReasons::energy_limited, no_change, swing_m_per_s,
       [](GloveCommand& wanted, int ms) { wanted.f_H_W.x() = 20.0 * swing_m_per_s(ms); }},
  };
}

/// A device a millisecond after the other, with commands that answer the newest state.
class Commands {
 public:
  explicit Commands(const EnvelopeCase& what) : case_(what) {
    DeviceDescriptor device = devices::simulated_glove_descriptor();
    case_.change(device);
    envelope_ = devices::SafetyEnvelope(device);
  }

  devices::SafeCommand limit_next() {
    ++ms_;
    const double speed = case_.speed_x(ms_);
    state_.sequence = ms_;
    state_.time = milliseconds(ms_);
    state_.v_WH.x() = speed;
    state_.X_WH.translation().x() += 1e-3 * speed;
    GloveCommand wanted;
    wanted.sequence = ms_;
    wanted.state_time = state_.time;
    case_.want(wanted, ms_);
    return envelope_.limit(wanted, state_, state_.time);
  }

 private:
  const EnvelopeCase& case_;
  devices::SafetyEnvelope envelope_{devices::simulated_glove_descriptor()};
  GloveState state_;
  int ms_ = 0;
};

/// The counter `cut` is the share of calls in which the limit reduced the command: of all limits, in the calm case.
void limit_commands(benchmark::State& state, const EnvelopeCase& what) {
  Commands commands(what);
  constexpr int kReturn_ms = 2000;  // the force has returned, and its mean has come up to the limit
  for (int ms = 0; ms < kReturn_ms; ++ms)
    commands.limit_next();
  std::int64_t cut = 0;
  for (auto _ : state) {
    const devices::SafeCommand safe = commands.limit_next();
    cut += (what.limit == nullptr ? safe.reasons().any() : safe.reasons().*what.limit) ? 1 : 0;
  }
  state.counters["cut"] = benchmark::Counter(static_cast<double>(cut), benchmark::Counter::kAvgIterations);
}

void register_envelope(const BenchOptions& /*options*/) {
  for (const EnvelopeCase& what : envelope_cases()) {
    benchmark::RegisterBenchmark((std::string("envelope/") + what.name + "/glissade").c_str(),
                                 [what](benchmark::State& state) { limit_commands(state, what); });
  }
}

}  // namespace
}  // namespace glissade::bench

int main(int argc, char** argv) {
  return glissade::bench::run_bench_program(
      argc, argv, "Measure the safety envelope: a call in calm contact, and calls whose command one of the limits cuts",
      glissade::bench::register_envelope);
}
