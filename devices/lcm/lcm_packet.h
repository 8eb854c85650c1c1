#pragma once

/// LCM's packets in UDP datagrams (LCM UDP multicast protocol, "small messages"). Packets of fragmented messages have
/// another form and are not taken: the messages of this library fit into one packet, and an assembly of fragments would
/// be one more way in for hostile packets.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace glissade::devices {

/// LCM allows longer names; no channel of this library needs one.
inline constexpr std::size_t kLongestChannelName = 15;

/// A message on a channel. Both refer to the bytes of the packet.
struct LcmPacket {
  std::string_view channel;
  std::span<const std::uint8_t> message;
};

/// The message in `bytes`. None if these are no packet of a small message, or if the name of the channel is empty or
/// too long.
std::optional<LcmPacket> parse_packet(std::span<const std::uint8_t> bytes) noexcept;

}  // namespace glissade::devices
