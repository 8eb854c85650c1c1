#pragma once

/// Message authentication codes of a bus with a key: keyed BLAKE2b, by libsodium.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace glissade::devices {

/// Immutable, so any number of threads may use it.
class MessageSeal {
 public:
  using Key = std::array<std::uint8_t, 32>;

  explicit MessageSeal(const Key& key);

  /// The message with its code behind it.
  std::vector<std::uint8_t> sealed(std::string_view channel, std::span<const std::uint8_t> message) const;

  /// The message without its code; none unless the code is that of this message, channel and key.
  std::optional<std::span<const std::uint8_t>> opened(std::string_view channel,
                                                      std::span<const std::uint8_t> bytes) const noexcept;

 private:
  using Code = std::array<std::uint8_t, 32>;
  Code code_of(std::string_view channel, std::span<const std::uint8_t> message) const noexcept;

  Key key_;
};

}  // namespace glissade::devices
