#include "dynamixel/measuring_board.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glissade/base/byte_order.h>

namespace glissade::bridges::dynamixel {
namespace {

constexpr std::string_view kBoardHead("\xAA\x55\x00\x00", 4);
constexpr std::int32_t kFullScale = 0x7FFFFF;  // of the converters, at 5 V
constexpr double kFullScale_V = 5.0;
constexpr std::uint32_t kLeastReference_uV = 1'000'000;
constexpr std::uint32_t kMostReference_uV = 6'000'000;

std::uint16_t board_checksum(const BoardFrame& frame) {
  std::uint32_t sum = frame.reference_uV;
  for (const std::int32_t word : frame.words)
    sum += static_cast<std::uint32_t>(word);
  return static_cast<std::uint16_t>(sum & 0xFFFFU);
}

bool can_be_measured(const BoardFrame& frame) {
  if (frame.reference_uV < kLeastReference_uV || frame.reference_uV > kMostReference_uV) return false;
  return std::all_of(frame.words.begin(), frame.words.end(),
                     [](std::int32_t word) { return word >= -kFullScale - 1 && word <= kFullScale; });
}

/// `bytes` has the size of a frame.
std::optional<BoardFrame> decode_board_frame(std::string_view bytes) {
  BoardFrame frame;
  frame.reference_uV = base::number_at<std::uint32_t>(bytes, 4);
  for (std::size_t i = 0; i < kBoardChannels; ++i)
    frame.words[i] = base::number_at<std::int32_t>(bytes, 8 + 4 * i);
  const auto last = base::number_at<std::uint32_t>(bytes, kBoardFrameSize - 4);
  frame.time_stamp = static_cast<std::uint16_t>(last & 0xFFFFU);
  if (last >> 16 != board_checksum(frame) || !can_be_measured(frame)) return std::nullopt;
  return frame;
}

}  // namespace

std::string encode(const BoardFrame& frame) {
  std::string bytes(kBoardHead);
  base::append_number(bytes, frame.reference_uV);
  for (const std::int32_t word : frame.words)
    base::append_number(bytes, word);
  base::append_number(bytes, static_cast<std::uint32_t>(board_checksum(frame)) << 16 | frame.time_stamp);
  return bytes;
}

std::array<double, kBoardChannels> board_angles(const BoardFrame& frame) noexcept {
  std::array<double, kBoardChannels> angles{};
  const double reference_V = frame.reference_uV * 1e-6;
  for (std::size_t i = 0; i < kBoardChannels; ++i)
    angles[i] = frame.words[i] * kFullScale_V / kFullScale / reference_V * 2.0 * std::numbers::pi;
  return angles;
}

std::int32_t board_word(double angle, std::uint32_t reference_uV) noexcept {
  const double volts = angle / (2.0 * std::numbers::pi) * reference_uV * 1e-6;
  return static_cast<std::int32_t>(std::clamp(std::round(volts / kFullScale_V * kFullScale), -8388608.0, 8388607.0));
}

void BoardDecoder::push(std::string_view bytes) {
  bytes_ += bytes;
}

void BoardDecoder::skip(std::size_t count) {
  skipped_bytes_ += count;
  bytes_.erase(0, count);
}

std::optional<BoardFrame> BoardDecoder::next() {
  while (true) {
    const std::size_t at = bytes_.find(kBoardHead);
    if (at == std::string::npos) {
      // The last bytes may be the first ones of a head.
      if (bytes_.size() >= kBoardHead.size()) skip(bytes_.size() - kBoardHead.size() + 1);
      return std::nullopt;
    }
    skip(at);
    if (bytes_.size() < kBoardFrameSize) return std::nullopt;
    if (const auto frame = decode_board_frame(std::string_view(bytes_).substr(0, kBoardFrameSize))) {
      bytes_.erase(0, kBoardFrameSize);
      return frame;
    }
    skip(1);  // the bytes of a head also occur in words
  }
}

}  // namespace glissade::bridges::dynamixel
