#pragma once

/// Messages of variable size with a checksum at their end.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <glissade/base/byte_order.h>

namespace glissade::haptics {

inline constexpr std::size_t kTypeBytes = 8;      // before the first field: LCM's fingerprint of the type
inline constexpr std::size_t kChecksumBytes = 8;  // the last field

inline constexpr std::uint64_t kFnvBasis = 0xcbf29ce484222325;
inline constexpr std::uint64_t kFnvPrime = 0x100000001b3;

inline std::int64_t fnv_1a(std::span<const std::uint8_t> bytes, std::uint64_t hash = kFnvBasis) {
  for (const std::uint8_t byte : bytes)
    hash = (hash ^ byte) * kFnvPrime;
  return static_cast<std::int64_t>(hash);
}

/// The same of several at once. Each product waits for the one before it; those of other hashes need not.
template <std::size_t N>
std::array<std::int64_t, N> fnv_1a_of_each(const std::array<std::span<const std::uint8_t>, N>& bytes) {
  std::array<std::uint64_t, N> hashes;
  hashes.fill(kFnvBasis);
  std::size_t common = bytes[0].size();
  for (const auto& each : bytes)
    common = std::min(common, each.size());
  for (std::size_t i = 0; i < common; ++i) {
    for (std::size_t k = 0; k < N; ++k)
      hashes[k] = (hashes[k] ^ bytes[k][i]) * kFnvPrime;
  }
  std::array<std::int64_t, N> result;
  for (std::size_t k = 0; k < N; ++k)
    result[k] = fnv_1a(bytes[k].subspan(common), hashes[k]);
  return result;
}

inline std::span<const std::uint8_t> checked_part(std::span<const std::uint8_t> bytes) {
  return bytes.subspan(kTypeBytes, bytes.size() - kTypeBytes - kChecksumBytes);
}

template <typename Message>
std::vector<std::uint8_t> to_bytes(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

/// Whether `bytes`, whose checksum was found right, are those of the message: equal bytes have the same checksum, which
/// takes longer to compute than all the rest.
template <typename Message>
bool is_of(std::span<const std::uint8_t> bytes, const Message& message) {
  const std::vector<std::uint8_t> own = to_bytes(message);
  return bytes.size() == own.size() && std::equal(own.begin(), own.end() - kChecksumBytes, bytes.begin());
}

/// The bytes of a message, of which `checksum` is the last field.
template <typename Message>
std::vector<std::uint8_t> to_checked_bytes(Message& message) {
  std::vector<std::uint8_t> bytes = to_bytes(message);
  message.checksum = fnv_1a(checked_part(bytes));
  const auto checksum = std::bit_cast<std::array<std::uint8_t, kChecksumBytes>>(message.checksum);
  static_assert(std::endian::native == std::endian::little);
  std::copy(checksum.rbegin(), checksum.rend(), bytes.end() - static_cast<std::ptrdiff_t>(kChecksumBytes));
  return bytes;
}

/// The message in `bytes`. Its first fields are the version and one count for each of `largest`; no value when one of
/// them is beyond its bound, or when the bytes are no such message. The checksum is not looked at.
template <typename Message, std::size_t N>
std::optional<Message> from_bytes(std::span<const std::uint8_t> bytes, const std::array<std::int32_t, N>& largest) {
  constexpr std::size_t kFirst = kTypeBytes + (N + 1) * sizeof(std::int32_t);
  if (bytes.size() < kFirst + kChecksumBytes) return std::nullopt;
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const auto number = [&](std::size_t i) {
    return base::number_at<std::int32_t>(text, kTypeBytes + i * sizeof(std::int32_t), std::endian::big);
  };
  if (number(0) != Message::VERSION) return std::nullopt;
  for (std::size_t i = 0; i < N; ++i) {
    if (number(i + 1) < 0 || number(i + 1) > largest[i]) return std::nullopt;
  }
  Message message;
  const auto size = static_cast<int>(bytes.size());
  if (message.decode(bytes.data(), 0, size) != size) return std::nullopt;
  return message;
}

/// The same, and no value when the bytes were changed.
template <typename Message, std::size_t N>
std::optional<Message> from_checked_bytes(std::span<const std::uint8_t> bytes,
                                          const std::array<std::int32_t, N>& largest) {
  std::optional<Message> message = from_bytes<Message>(bytes, largest);
  if (message && message->checksum != fnv_1a(checked_part(bytes))) message.reset();
  return message;
}

}  // namespace glissade::haptics
