// Bytes from a bus of Dynamixel servos and from a measuring board. Whatever arrives, and in whatever pieces, both
// decoders find the same packets and frames, and an emulated servo survives all instructions.

#include <chrono>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <glissade/base/byte_order.h>

#include "dynamixel/emulated_bus.h"
#include "dynamixel/measuring_board.h"
#include "dynamixel/packet.h"
#include "dynamixel/registers.h"
#include "elastic_finger.h"
#include "fuzz_target.h"

namespace glissade::fuzz {
namespace {

using namespace bridges::dynamixel;

constexpr std::string_view kPacketHead("\xFF\xFF\xFD\x00", 4);
constexpr std::string_view kFrameHead("\xAA\x55\x00\x00", 4);
constexpr std::size_t kPieceSize = 7;

void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

template <class Decoder>
auto all_of(Decoder& decoder) {
  std::vector<typename decltype(decoder.next())::value_type> found;
  while (auto one = decoder.next())
    found.push_back(*one);
  return found;
}

/// What the decoder finds if the bytes arrive in pieces.
template <class Decoder>
auto found_in_pieces(Decoder& decoder, std::string_view bytes) {
  auto found = all_of(decoder);
  for (; !bytes.empty(); bytes.remove_prefix(std::min(kPieceSize, bytes.size()))) {
    decoder.push(bytes.substr(0, kPieceSize));
    for (auto& one : all_of(decoder))
      found.push_back(one);
  }
  return found;
}

bool try_packets(std::string_view bytes) {
  PacketDecoder decoder;
  decoder.push(bytes);
  const std::vector<Packet> packets = all_of(decoder);
  PacketDecoder in_pieces;
  require(found_in_pieces(in_pieces, bytes) == packets, "packets that depend on the pieces of the stream");
  std::size_t size = 0;
  for (const Packet& packet : packets) {
    const std::string again = encode(packet);
    size += again.size();
    if (again.size() > kLongestPacket) continue;  // stuffing that was missing has made it longer
    PacketDecoder of_one;
    of_one.push(again);
    require(of_one.next() == packet, "a packet that does not come back");
  }
  return decoder.skipped_bytes() == 0 && size == bytes.size();
}

bool try_frames(std::string_view bytes) {
  BoardDecoder decoder;
  decoder.push(bytes);
  const std::vector<BoardFrame> frames = all_of(decoder);
  BoardDecoder in_pieces;
  require(found_in_pieces(in_pieces, bytes) == frames, "frames that depend on the pieces of the stream");
  for (const BoardFrame& frame : frames) {
    for (const double angle : board_angles(frame))
      require(angle > -100.0 && angle < 100.0, "an impossible angle");
  }
  return frames.size() * kBoardFrameSize == bytes.size();
}

void try_servos(std::string_view bytes) {
  const auto finger = std::make_shared<ElasticFinger>(1.0, 0.5, 0.025);
  EmulatedBus bus({{1, *find_model("XL330-M288"), finger}, {2, *find_model("XL330-M288"), finger}}, 3e6);
  std::chrono::nanoseconds now{0};
  while (!bytes.empty()) {
    const std::string_view piece = bytes.substr(0, 64);
    bytes.remove_prefix(piece.size());
    now += std::chrono::milliseconds(1);
    bus.receive(piece, now);
    bus.send_until(now);
  }
  require(finger->angle() > -1e3 && finger->angle() < 1e3, "a finger that flies away");
}

std::string instructions() {
  const auto number = [](std::uint16_t value) {
    std::string bytes;
    base::append_number(bytes, value);
    return bytes;
  };
  const std::string ids("\1\2", 2);
  return encode(Packet{kBroadcastId, Instruction::kPing, {}}) +
         encode(Packet{1, Instruction::kWrite, number(kOperatingMode.address) + "\5"}) +
         encode(Packet{1, Instruction::kWrite, number(kTorqueEnable.address) + "\1"}) +
         encode(Packet{1, Instruction::kRead, number(kPresentCurrent.address) + number(10)}) +
         encode(Packet{kBroadcastId, Instruction::kSyncRead, number(132) + number(4) + ids}) +
         encode(Packet{kBroadcastId, Instruction::kFastSyncRead, number(132) + number(4) + ids}) +
         encode(Packet{kBroadcastId, Instruction::kSyncWrite, number(102) + number(2) + "\1\2\3\2\2\3"}) +
         encode(Packet{2, Instruction::kReboot, {}});
}

std::string frames() {
  BoardFrame frame{.reference_uV = 3'300'000, .time_stamp = 9};
  frame.words[2] = 0x000055AA;
  frame.words[7] = -1;
  return encode(frame) + encode(BoardFrame{.reference_uV = 5'000'000});
}

}  // namespace

bool try_input(std::string_view bytes) {
  try_servos(bytes);
  const bool are_packets = try_packets(bytes);
  const bool are_frames = try_frames(bytes);
  return are_packets || are_frames;
}

std::vector<Seed> seeds() {
  const std::string stuffed = encode(Packet{1, Instruction::kWrite, "\xFF\xFF\xFD\xFF\xFF\xFD\xFD"});
  return {{"instructions", instructions()}, {"stuffed", stuffed}, {"frames", frames()}};
}

std::vector<std::string> dictionary() {
  return {std::string(kPacketHead), std::string(kFrameHead), "\xFF\xFF\xFD", "\xFF\xFF\xFD\xFD", "\xFE"};
}

// Lengths and checksums of packets from one head to the next, and checksums of frames.
void repair(std::string& bytes) {
  for (std::size_t at = bytes.find(kPacketHead); at != std::string::npos;) {
    const std::size_t end = std::min(bytes.find(kPacketHead, at + 1), bytes.size());
    if (end - at >= 10) {
      std::string length;
      base::append_number(length, static_cast<std::uint16_t>(end - at - 7));
      bytes.replace(at + 5, 2, length);
      std::string checksum;
      base::append_number(checksum, crc16(std::string_view(bytes).substr(at, end - at - 2)));
      bytes.replace(end - 2, 2, checksum);
    }
    at = bytes.find(kPacketHead, at + 1);
  }
  for (std::size_t at = bytes.find(kFrameHead); at != std::string::npos && at + kBoardFrameSize <= bytes.size();
       at = bytes.find(kFrameHead, at + kBoardFrameSize)) {
    BoardFrame frame{.reference_uV = base::number_at<std::uint32_t>(bytes, at + 4)};
    for (std::size_t i = 0; i < kBoardChannels; ++i)
      frame.words[i] = base::number_at<std::int32_t>(bytes, at + 8 + 4 * i);
    bytes.replace(at, kBoardFrameSize, encode(frame));
  }
}

}  // namespace glissade::fuzz
