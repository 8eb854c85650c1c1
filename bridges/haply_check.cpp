#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include <glissade/bridges/haply_check.h>
#include <glissade/realtime/clock.h>

#include "haply/arm_choice.h"
#include "haply/json_field.h"
#include "haply/service_message.h"
#include "haply/web_socket.h"

namespace glissade::bridges {
namespace {

using Say = std::function<void(const std::string&)>;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr milliseconds kListens{1500};

std::string rounded(double value, const char* format) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

/// The version that the service tells, or what hides it.
std::string version_of_service(const ServiceAddress& address) {
  const std::optional<std::string> page = WebSocket::get(address, "/version");
  if (!page) return "not told";
  constexpr bool kThrows = false;
  const nlohmann::json document = nlohmann::json::parse(*page, nullptr, kThrows);
  try {
    return JsonField(document).at("project_version").text();
  } catch (const std::invalid_argument&) {
    return "not told";
  }
}

ServiceMessage inventory_of(const ServiceAddress& address) {
  WebSocket socket(address);
  socket.open();
  const std::optional<std::string> text = socket.receive(milliseconds(1000));
  if (!text) throw WireError(socket.name() + ": it accepts a connection, but says nothing");
  try {
    return decode_service_message(*text);
  } catch (const std::invalid_argument& error) {
    throw WireError(socket.name() +
                    ": its first message is none of Haply's Inverse Service from version 3.1 on: " + error.what());
  }
}

std::string description_of(const HaplyArm& arm) {
  std::string text = arm.id;
  if (!arm.config) return text;
  text += "  " + arm.config->type + ", hardware " + std::to_string(arm.config->hardware) + ", firmware " +
          std::to_string(arm.config->firmware);
  if (!arm.config->handedness.empty()) text += ", " + arm.config->handedness + " hand";
  if (!arm.config->port.empty()) text += ", at " + arm.config->port;
  return text;
}

std::string description_of(const HaplyHandle& handle) {
  return handle.id + (handle.is_wireless ? "  wireless VerseGrip" : "  VerseGrip with a cable");
}

void tell_devices(const ServiceMessage& inventory, const Say& say) {
  for (const HaplyArm& arm : inventory.arms) {
    say(description_of(arm));
    if (const std::string trouble = trouble_of(arm); !trouble.empty()) say("    " + trouble);
    if (arm.status.is_in_use) say("    another program uses it; the forces of both add up");
  }
  for (const HaplyHandle& handle : inventory.handles)
    say(description_of(handle));
}

void tell_filters(const ServiceMessage& inventory, const HaplyArm& arm, const Say& say) {
  if (inventory.force_key == ForceKey::kValues) {
    say("the service is older than 3.5 and does not tell its filters");
    return;
  }
  if (arm.config && arm.config->damping_N_s_per_m.value_or(0.0) != 0.0)
    say("the service adds a damping of " + rounded(*arm.config->damping_N_s_per_m, "%.2g") +
        " N s/m; the bridge turns it off for itself");
  if (arm.config && arm.config->force_gate)
    say("the service's force gate has a gain of " + rounded(*arm.config->force_gate, "%.2g") +
        ": it weakens a force that oscillates. Its oscillation damper does, too, and cannot be turned off");
}

/// Exchanges messages without a force.
bool listen(const HaplyOptions& options, const std::function<bool()>& goes_on, const Say& say) {
  HaplyWire wire(options);
  wire.open();
  const realtime::SteadyClock clock;
  const nanoseconds start = clock.now();
  nanoseconds longest{0};
  devices::GloveState state;
  while (goes_on() && clock.now() - start < kListens) {
    if (wire.read(state)) longest = std::max(longest, clock.now() - state.time);
    wire.write({});
  }
  const HaplyTraffic& traffic = wire.traffic();
  const double time_s = std::chrono::duration<double>(clock.now() - start).count();
  if (traffic.states == 0) {
    say("no states arrive: " + (traffic.last_refusal.empty() ? "the service is silent" : traffic.last_refusal));
    return false;
  }
  const Eigen::Vector3d p_WH = state.X_WH.translation();
  say("the tip is at " + rounded(p_WH.x(), "%.3f") + " " + rounded(p_WH.y(), "%.3f") + " " + rounded(p_WH.z(), "%.3f") +
      " m in the world");
  const double rate_Hz = static_cast<double>(traffic.states) / time_s;
  say(rounded(rate_Hz, "%.0f") + " states/s, the slowest answer after " +
      rounded(std::chrono::duration<double>(longest).count() * 1e3, "%.1f") + " ms, " +
      std::to_string(traffic.refused) + " messages that were no states");
  constexpr double kSlow_Hz = 500.0;
  if (rate_Hz < kSlow_Hz) say("that is slow: below 500 states/s, objects feel soft");
  return true;
}

}  // namespace

void list_haply_devices(const std::string& service, const Say& say) {
  tell_devices(inventory_of(parse_service_address(service)), say);
}

bool check_haply(const HaplyOptions& options, const std::function<bool()>& goes_on, const Say& say) {
  const ServiceAddress address = parse_service_address(options.service);
  try {
    const ServiceMessage inventory = inventory_of(address);
    say("service " + address.text() + ": Haply's Inverse Service, version " + version_of_service(address));
    tell_devices(inventory, say);
    const HaplyArm& arm = chosen_arm(inventory, options.arm);
    const HaplyHandle* handle = chosen_handle(inventory, options.handle);
    if (const std::string trouble = trouble_of(arm); !trouble.empty()) return false;
    if (handle == nullptr) say("there is no VerseGrip: the hand does not turn, and never lets go of a part");
    tell_filters(inventory, arm, say);
    return listen(options, goes_on, say);
  } catch (const WireError& error) {
    say(error.what());
    return false;
  }
}

}  // namespace glissade::bridges
