#include "dynamixel/packet.h"

#include <algorithm>
#include <array>

#include <glissade/base/byte_order.h>

namespace glissade::bridges::dynamixel {
namespace {

constexpr std::string_view kHead("\xFF\xFF\xFD\x00", 4);
constexpr std::string_view kToStuff("\xFF\xFF\xFD", 3);
constexpr std::size_t kBeforeInstruction = 7;  // head, id and length
constexpr std::size_t kChecksumSize = 2;
constexpr std::size_t kShortest = 1 + kChecksumSize;  // of what the length counts: instruction and checksum

constexpr std::array<std::uint16_t, 256> make_crc_table() {
  std::array<std::uint16_t, 256> table{};
  for (unsigned byte = 0; byte < 256; ++byte) {
    unsigned crc = byte << 8;
    for (int bit = 0; bit < 8; ++bit)
      crc = (crc & 0x8000U) != 0 ? (crc << 1) ^ 0x8005U : crc << 1;
    table[byte] = static_cast<std::uint16_t>(crc & 0xFFFFU);
  }
  return table;
}

constexpr std::array<std::uint16_t, 256> kCrcTable = make_crc_table();

/// Counts from the instruction on.
std::size_t length_field(std::string_view packet) {
  return base::number_at<std::uint16_t>(packet, 5);
}

std::string stuffed(std::string_view content) {
  std::string result;
  while (true) {
    const std::size_t at = content.find(kToStuff);
    if (at == std::string_view::npos) return result.append(content);
    result.append(content.substr(0, at + kToStuff.size())).push_back('\xFD');
    content.remove_prefix(at + kToStuff.size());
  }
}

std::string unstuffed(std::string_view content) {
  std::string result;
  while (true) {
    const std::size_t at = content.find(kToStuff);
    if (at == std::string_view::npos) return result.append(content);
    result.append(content.substr(0, at + kToStuff.size()));
    content.remove_prefix(at + kToStuff.size());
    if (content.starts_with('\xFD')) content.remove_prefix(1);
  }
}

bool is_answer_of_all(std::uint8_t id, std::uint8_t instruction) {
  return id == kBroadcastId && instruction == static_cast<std::uint8_t>(Instruction::kStatus);
}

}  // namespace

std::uint16_t crc16(std::string_view bytes) noexcept {
  unsigned crc = 0;
  for (const char byte : bytes) {
    const unsigned index = (crc >> 8) ^ static_cast<unsigned char>(byte);
    crc = ((crc << 8) & 0xFFFFU) ^ kCrcTable[index];
  }
  return static_cast<std::uint16_t>(crc);
}

std::string encode(const Packet& packet) {
  const auto instruction = static_cast<std::uint8_t>(packet.instruction);
  std::string content(1, static_cast<char>(instruction));
  content += packet.parameters;
  if (!is_answer_of_all(packet.id, instruction)) content = stuffed(content);
  std::string result(kHead);
  result.push_back(static_cast<char>(packet.id));
  base::append_number(result, static_cast<std::uint16_t>(content.size() + kChecksumSize));
  result += content;
  base::append_number(result, crc16(result));
  return result;
}

void PacketDecoder::push(std::string_view bytes) {
  bytes_ += bytes;
}

void PacketDecoder::clear() noexcept {
  skipped_bytes_ += bytes_.size();
  bytes_.clear();
}

void PacketDecoder::skip(std::size_t count) {
  skipped_bytes_ += count;
  bytes_.erase(0, count);
}

/// Skips what cannot begin a packet. Returns whether a head is there.
bool PacketDecoder::find_head() {
  const std::size_t at = bytes_.find(kHead);
  if (at != std::string::npos) {
    skip(at);
    return true;
  }
  // The last bytes may be the first ones of a head.
  for (std::size_t kept = std::min(bytes_.size(), kHead.size() - 1); kept > 0; --kept) {
    if (!kHead.starts_with(std::string_view(bytes_).substr(bytes_.size() - kept))) continue;
    skip(bytes_.size() - kept);
    return false;
  }
  skip(bytes_.size());
  return false;
}

/// Whether another packet begins inside the first one, of which `size` bytes are expected. Stuffing rules this out
/// before the checksum, except in answers of all servos.
bool PacketDecoder::is_cut(std::size_t size) const noexcept {
  if (static_cast<std::uint8_t>(bytes_[4]) == kBroadcastId) return false;
  const std::size_t at = bytes_.find(kHead, kHead.size());
  return at != std::string::npos && at + kHead.size() + kChecksumSize <= size;
}

std::optional<Packet> PacketDecoder::next() {
  while (find_head() && bytes_.size() >= kBeforeInstruction) {
    const std::size_t length = length_field(bytes_);
    const std::size_t size = kBeforeInstruction + length;
    if (length < kShortest || length > kLongestPacket || is_cut(size)) {
      skip(kHead.size());
      continue;
    }
    if (bytes_.size() < size) return std::nullopt;
    const std::string_view whole = std::string_view(bytes_).substr(0, size);
    if (crc16(whole.substr(0, size - kChecksumSize)) != base::number_at<std::uint16_t>(whole, size - kChecksumSize)) {
      ++wrong_checksums_;
      skip(kHead.size());
      continue;
    }
    const auto id = static_cast<std::uint8_t>(whole[4]);
    const auto instruction = static_cast<std::uint8_t>(whole[kBeforeInstruction]);
    std::string content(whole.substr(kBeforeInstruction, length - kChecksumSize));
    if (!is_answer_of_all(id, instruction)) content = unstuffed(content);
    Packet packet{id, Instruction{instruction}, content.substr(1)};
    bytes_.erase(0, size);
    return packet;
  }
  return std::nullopt;
}

}  // namespace glissade::bridges::dynamixel
