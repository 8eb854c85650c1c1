// Datagrams at both ends of a glove's link, one a millisecond: packet, decoder, filter, envelope. Whatever arrives, the
// device gets finite forces within its limits, and no jump.
//
// An input is a row of datagrams, each behind its size in two bytes.

#include <chrono>
#include <cmath>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

#include <glissade/base/byte_order.h>
#include <glissade/devices/safety_envelope.h>
#include <glissade/devices/simulated_glove.h>

#include "fuzz_target.h"
#include "lcm/glove_messages.h"
#include "lcm/haptic_state_message.h"
#include "lcm/lcm_packet.h"
#include "lcm/link_monitor.h"

namespace glissade::fuzz {
namespace {

using namespace devices;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

std::string bytes_of(const std::vector<std::uint8_t>& bytes) {
  return {bytes.begin(), bytes.end()};
}

std::string datagram(const char* channel, const std::vector<std::uint8_t>& message) {
  return std::string("LC02\0\0\0\0", 8) + channel + '\0' + bytes_of(message);
}

std::string framed(const std::string& datagram) {
  std::string result;
  base::append_number(result, static_cast<std::uint16_t>(datagram.size()));
  return result + datagram;
}

/// Calls `use` for each datagram of an input; returns false if the last one is cut.
template <typename Use>
bool for_each_datagram(std::string_view bytes, const Use& use) {
  while (bytes.size() >= 2) {
    const std::size_t size = static_cast<unsigned char>(bytes[0]) + 256U * static_cast<unsigned char>(bytes[1]);
    if (bytes.size() - 2 < size) return false;
    use(bytes.substr(2, size));
    bytes.remove_prefix(2 + size);
  }
  return bytes.empty();
}

/// Both ends of a link, with the envelope of the device behind them.
class Link {
 public:
  /// Takes a datagram at `now`; returns whether it was used.
  bool take(std::string_view datagram, nanoseconds now) {
    const auto* const first = reinterpret_cast<const std::uint8_t*>(datagram.data());
    const auto packet = parse_packet({first, datagram.size()});
    if (!packet) return false;
    if (packet->channel == kGloveStateChannel) return take_state(packet->message, now);
    if (packet->channel == kGloveCommandChannel) return take_command(packet->message, now);
    if (packet->channel == kGloveInfoChannel) return take_info(packet->message);
    return take_haptic_state(packet->message);
  }

  /// One period of the device.
  void tick(nanoseconds now) {
    const SafeCommand safe = envelope_.limit(command_, state_, now);
    const Eigen::Vector3d f = safe.values().f_H_W;
    const Eigen::Vector3d t = safe.values().t_H_W;
    constexpr double kRounding = 1.0 + 1e-9;
    const DeviceDescriptor& device = envelope_.descriptor();
    require(f.allFinite() && t.allFinite(), "a force that is not finite");
    require(f.norm() <= device.max_force * kRounding, "a force beyond the limit");
    require(t.norm() <= device.max_torque * kRounding, "a torque beyond the limit");
    require((f - last_f_).norm() <= device.max_force / 7.0 * kRounding, "a force that jumps");
    require((t - last_t_).norm() <= device.max_torque / 7.0 * kRounding, "a torque that jumps");
    for (const double torque : safe.values().joint_torques) {
      require(std::abs(torque) <= device.max_joint_torque, "a joint torque beyond the limit");
    }
    last_f_ = f;
    last_t_ = t;
  }

 private:
  bool take_state(std::span<const std::uint8_t> message, nanoseconds now) {
    StateHeader header;
    GloveState state;
    const DecodeResult result = decode(message, header, state);
    if (!states_.admit(result, {header.device, header.session, state.sequence}, now)) return false;
    state_ = state;
    return true;
  }

  /// Viewers use the counts as they come.
  static bool take_haptic_state(std::span<const std::uint8_t> message) {
    HapticState state;
    if (decode(message, state) != MessageError::kNone) return false;
    const auto is_up_to = [](std::int32_t count, std::size_t most) {
      return count >= 0 && static_cast<std::size_t>(count) <= most;
    };
    require(is_up_to(state.part_count, kHapticParts) && is_up_to(state.hand_count, kHapticHands) &&
                is_up_to(state.contact_count, kHapticContacts) && is_up_to(state.patch_count, kHapticPatches),
            "more of a haptic state than there is room for");
    return true;
  }

  static bool take_info(std::span<const std::uint8_t> message) {
    GloveInfo info;
    if (decode(message, info) != MessageError::kNone) return false;
    const SafetyEnvelope envelope(info.descriptor);  // what was decoded is valid
    return true;
  }

  bool take_command(std::span<const std::uint8_t> message, nanoseconds now) {
    CommandHeader header;
    GloveCommand command;
    const DecodeResult result = decode(message, header, command);
    if (!commands_.admit(result, {header.device, header.session, command.sequence}, now)) return false;
    command_ = command;
    return true;
  }

  LinkMonitor states_{milliseconds(500)};
  LinkMonitor commands_{milliseconds(500)};
  SafetyEnvelope envelope_{simulated_glove_descriptor()};
  GloveState state_;
  GloveCommand command_;
  Eigen::Vector3d last_f_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d last_t_ = Eigen::Vector3d::Zero();
};

GloveState state_at(int tick) {
  GloveState state;
  state.sequence = tick;
  state.time = milliseconds(2 * tick);
  state.X_WH.translation().x() = 1e-4 * tick;
  state.v_WH.x() = 0.1;
  return state;
}

std::string state_datagram(int tick) {
  return datagram(kGloveStateChannel, encode(StateHeader{1, 7, 0, hands::HandSide::kLeft}, state_at(tick)));
}

std::string command_datagram(int tick) {
  GloveCommand command;
  command.sequence = tick;
  command.state_sequence = tick;
  command.state_time = milliseconds(2 * tick);
  command.f_H_W.z() = 15.0;
  command.joint_torques[3] = 0.1;
  return datagram(kGloveCommandChannel, encode(CommandHeader{1, 7, 9}, command));
}

std::string info_datagram() {
  return datagram(kGloveInfoChannel, encode(GloveInfo{1, 7, hands::HandSide::kLeft, simulated_glove_descriptor()}));
}

std::string viewer_datagram() {
  HapticState state;
  state.patch_count = 1;
  state.patches[0] = {1, 4, {0.1F, 0.0F, 0.0F}, Eigen::Vector3f::UnitZ(), 0.02F};
  state.hands[0].visible.form = hands::GraspForm::kKey;
  state.hands[0].visible.touching = 0x8888;
  return datagram(kHapticStateChannel, encode(state));
}

}  // namespace

bool try_input(std::string_view bytes) {
  Link link;
  nanoseconds now{0};
  bool all_taken = true;
  const bool is_whole = for_each_datagram(bytes, [&](std::string_view one) {
    now += milliseconds(1);
    all_taken = link.take(one, now) && all_taken;
    link.tick(now);
  });
  return is_whole && all_taken;
}

std::vector<Seed> seeds() {
  std::string pressing;
  for (int tick = 1; tick <= 40; ++tick)
    pressing += framed(state_datagram(tick)) + framed(command_datagram(tick));
  return {{"pressing", pressing},
          {"info", framed(info_datagram())},
          {"viewer", framed(viewer_datagram())},
          {"state", framed(state_datagram(1))}};
}

std::vector<std::string> dictionary() {
  return {"LC02",
          "LC03",
          kGloveStateChannel,
          kGloveCommandChannel,
          kGloveInfoChannel,
          std::string("\x7f\xf8\0\0\0\0\0\0", 8),  // NaN
          std::string("\x7f\xf0\0\0\0\0\0\0", 8),  // infinity
          std::string("\x7f\xff\xff\xff\xff\xff\xff\xff", 8)};
}

// Each datagram gets the head of the valid one whose channel it names, down to the version.
void repair(std::string& bytes) {
  std::string repaired;
  for_each_datagram(bytes, [&](std::string_view one) {
    std::string fixed(one);
    for (const std::string& valid : {state_datagram(1), command_datagram(1), info_datagram(), viewer_datagram()}) {
      constexpr std::size_t kPacketHead = 8;
      const std::size_t head = valid.find('\0', kPacketHead) + 1 + 8 + 4;  // and fingerprint, version
      const bool is_of_this_channel =
          fixed.compare(kPacketHead < fixed.size() ? kPacketHead : 0, 8, valid, kPacketHead, 8) == 0;
      if (!is_of_this_channel || fixed.size() < head) continue;
      fixed.replace(0, head, valid, 0, head);
      fixed.resize(valid.size(), '\0');
    }
    repaired += framed(fixed);
  });
  bytes = repaired;
}

}  // namespace glissade::fuzz
