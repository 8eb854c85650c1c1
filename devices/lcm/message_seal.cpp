#include "lcm/message_seal.h"

#include <stdexcept>
#include <tuple>

#include <sodium.h>

namespace glissade::devices {

MessageSeal::MessageSeal(const Key& key) : key_(key) {
  if (sodium_init() < 0) throw std::runtime_error("libsodium cannot be initialised");
}

std::vector<std::uint8_t> MessageSeal::sealed(std::string_view channel, std::span<const std::uint8_t> message) const {
  const Code code = code_of(channel, message);
  std::vector<std::uint8_t> bytes(message.begin(), message.end());
  bytes.insert(bytes.end(), code.begin(), code.end());
  return bytes;
}

std::optional<std::span<const std::uint8_t>> MessageSeal::opened(std::string_view channel,
                                                                 std::span<const std::uint8_t> bytes) const noexcept {
  constexpr std::size_t kCodeSize = std::tuple_size_v<Code>;
  if (bytes.size() < kCodeSize) return std::nullopt;
  const std::span<const std::uint8_t> message = bytes.first(bytes.size() - kCodeSize);
  const Code code = code_of(channel, message);
  if (sodium_memcmp(code.data(), bytes.data() + message.size(), kCodeSize) != 0) return std::nullopt;
  return message;
}

MessageSeal::Code MessageSeal::code_of(std::string_view channel, std::span<const std::uint8_t> message) const noexcept {
  Code code{};
  crypto_generichash_state state;
  crypto_generichash_init(&state, key_.data(), key_.size(), code.size());
  // Names of channels contain no zero, so the zero behind the name ends it.
  const std::uint8_t end = 0;
  crypto_generichash_update(&state, reinterpret_cast<const std::uint8_t*>(channel.data()), channel.size());
  crypto_generichash_update(&state, &end, 1);
  crypto_generichash_update(&state, message.data(), message.size());
  crypto_generichash_final(&state, code.data(), code.size());
  return code;
}

}  // namespace glissade::devices
