#include <thread>
#include <utility>

#include <glissade/bridges/bridge.h>
#include <glissade/realtime/clock.h>

namespace glissade::bridges {
namespace {

/// Exchanges states and commands until the wire fails, which it throws, or the bridge is to end. Calls `greet` at the
/// first state.
void exchange(Wire& wire, devices::LcmGloveHost& host, devices::GloveState& state, BridgeStatistics& statistics,
              const std::function<bool()>& goes_on, const std::function<void()>& greet) {
  bool is_first = true;
  while (goes_on()) {
    if (wire.read(state)) {
      if (std::exchange(is_first, false)) greet();
      ++state.sequence;
      ++statistics.states;
      host.publish(state);
    }
    // Also without a new measurement: the envelope lets the force fade as the last one grows old.
    wire.write(host.newest_command(state));
  }
}

}  // namespace

BridgeStatistics run_bridge(Wire& wire, const std::shared_ptr<devices::LcmBus>& bus, const BridgeOptions& options,
                            const std::function<bool()>& goes_on, const std::function<void(const std::string&)>& say) {
  devices::LcmGloveHost host(bus, wire.descriptor(), options.link);
  devices::GloveState state;
  state.X_WH = options.X_WH;
  BridgeStatistics statistics;
  std::uint64_t failures = 0;  // since the last state
  const auto greet = [&] {
    say(statistics.states > 0 ? "the device is back" : "the device is connected");
    failures = 0;
  };
  while (goes_on()) {
    try {
      wire.open();
      exchange(wire, host, state, statistics, goes_on, greet);
    } catch (const WireError& error) {
      constexpr std::uint64_t kSaidAgain = 20;
      if (failures % kSaidAgain == 0) say(error.what());
      ++failures;
      ++statistics.errors;
      wire.release();
      const auto again = std::chrono::steady_clock::now() + options.reopen_after;
      while (goes_on() && std::chrono::steady_clock::now() < again) {
        // The command fades meanwhile: none from before the failure may act on a device that is back.
        host.newest_command(state);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
    }
  }
  wire.release();
  return statistics;
}

}  // namespace glissade::bridges
