#include "lcm/lcm_packet.h"

#include <algorithm>
#include <array>

namespace glissade::devices {

namespace {
constexpr std::array<std::uint8_t, 4> kSmallMessage{'L', 'C', '0', '2'};
constexpr std::size_t kHead = 8;  // the four bytes above and a sequence number, by which liblcm counts losses
}  // namespace

std::optional<LcmPacket> parse_packet(std::span<const std::uint8_t> bytes) noexcept {
  if (bytes.size() < kHead || !std::equal(kSmallMessage.begin(), kSmallMessage.end(), bytes.begin())) {
    return std::nullopt;
  }
  const std::span<const std::uint8_t> rest = bytes.subspan(kHead);
  const std::span<const std::uint8_t> start = rest.first(std::min(rest.size(), kLongestChannelName + 1));
  const auto end = std::find(start.begin(), start.end(), std::uint8_t{0});
  const auto length = static_cast<std::size_t>(end - start.begin());
  if (end == start.end() || length == 0) return std::nullopt;
  return LcmPacket{{reinterpret_cast<const char*>(rest.data()), length}, rest.subspan(length + 1)};
}

}  // namespace glissade::devices
