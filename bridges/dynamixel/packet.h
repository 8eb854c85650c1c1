#pragma once

/// Packets of the Dynamixel protocol 2.0: FF FF FD 00, id, length, instruction, parameters, checksum.
/// Source: emanual.robotis.com/docs/en/dxl/protocol2.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace glissade::bridges::dynamixel {

enum class Instruction : std::uint8_t {
  kPing = 0x01,
  kRead = 0x02,
  kWrite = 0x03,
  kReboot = 0x08,
  kStatus = 0x55,  ///< the answer of a servo
  kSyncRead = 0x82,
  kSyncWrite = 0x83,
  kFastSyncRead = 0x8A,
};

/// All servos of a bus.
inline constexpr std::uint8_t kBroadcastId = 0xFE;
/// The largest id of a servo.
inline constexpr std::uint8_t kLastId = 252;

/// An instruction, or the answer to one.
struct Packet {
  std::uint8_t id = 0;
  Instruction instruction = Instruction::kStatus;
  /// Bytes after the instruction, without stuffing. In an answer, the first one is the error.
  std::string parameters;

  bool operator==(const Packet&) const = default;
};

/// CRC-16 with the polynomial 0x8005 and the initial value 0, the most significant bit first.
std::uint16_t crc16(std::string_view bytes) noexcept;

/// The bytes of a packet on the line. Wherever FF FF FD occurs between length and checksum, FD follows (byte stuffing),
/// so that no packet contains the head of another. Answers of all servos together (id kBroadcastId) are not stuffed.
std::string encode(const Packet& packet);

/// The rest of a packet after the length field must not be longer (bytes).
inline constexpr std::size_t kLongestPacket = 1024;

/// Finds the packets in a stream of bytes. Garbage, cut packets and packets with a wrong checksum are skipped and
/// counted. Keeps less than two packets of the greatest length. Cost: O(bytes), except for streams made of false heads.
class PacketDecoder {
 public:
  /// Appends bytes of the line.
  void push(std::string_view bytes);

  /// The next whole packet; no value if more bytes must arrive first.
  std::optional<Packet> next();

  /// Drops all bytes that are not yet part of a packet.
  void clear() noexcept;

  /// Bytes that were part of no valid packet.
  std::uint64_t skipped_bytes() const noexcept { return skipped_bytes_; }
  /// Packets with a wrong checksum.
  std::uint64_t wrong_checksums() const noexcept { return wrong_checksums_; }

 private:
  bool find_head();
  bool is_cut(std::size_t size) const noexcept;
  void skip(std::size_t count);

  std::string bytes_;
  std::uint64_t skipped_bytes_ = 0;
  std::uint64_t wrong_checksums_ = 0;
};

}  // namespace glissade::bridges::dynamixel
