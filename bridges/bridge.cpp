#include <thread>

#include <glissade/bridges/bridge.h>
#include <glissade/realtime/clock.h>

namespace glissade::bridges {
namespace {

/// Exchanges states and commands until the wire fails, which it throws, or the bridge is to end.
void exchange(Wire& wire, devices::LcmGloveHost& host, devices::GloveState& state, BridgeStatistics& statistics,
              const std::function<bool()>& goes_on) {
  while (goes_on()) {
    if (wire.read(state)) {
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
  BridgeStatistics statistics;
  bool has_failed = false;
  while (goes_on()) {
    try {
      wire.open();
      say(has_failed ? "the device is back" : "the device is connected");
      exchange(wire, host, state, statistics, goes_on);
    } catch (const WireError& error) {
      if (!has_failed || statistics.errors % 20 == 0) say(error.what());
      has_failed = true;
      ++statistics.errors;
      wire.release();
      const auto again = std::chrono::steady_clock::now() + options.reopen_after;
      while (goes_on() && std::chrono::steady_clock::now() < again)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
  wire.release();
  return statistics;
}

}  // namespace glissade::bridges
