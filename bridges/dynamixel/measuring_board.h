#pragma once

/// The measuring board of the DOGlove: potentiometers read by two converters of 24 bits. It sends frames of 76 bytes
/// without being asked: AA 55 00 00, the reference voltage in µV, 16 converter words, and a word with a checksum (upper
/// half) and a time stamp (lower half), all little-endian. Source: github.com/TEA-Lab/DOGlove.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace glissade::bridges::dynamixel {

inline constexpr std::size_t kBoardChannels = 16;
inline constexpr std::size_t kBoardFrameSize = 76;

/// A frame of the board as it is on the line.
struct BoardFrame {
  std::uint32_t reference_uV = 0;  ///< voltage across the potentiometers
  std::array<std::int32_t, kBoardChannels> words{};
  std::uint16_t time_stamp = 0;

  bool operator==(const BoardFrame&) const = default;
};

std::string encode(const BoardFrame& frame);

/// The angles (rad, 0 to 2π) of the potentiometers.
std::array<double, kBoardChannels> board_angles(const BoardFrame& frame) noexcept;
/// The word of a potentiometer at this angle (rad), with a reference voltage.
std::int32_t board_word(double angle, std::uint32_t reference_uV) noexcept;

/// Finds frames in a stream of bytes. Skips garbage, cut frames, wrong checksums, and frames whose numbers the
/// converters cannot give: a reference voltage outside 1 to 6 V, or words of more than 24 bits.
class BoardDecoder {
 public:
  void push(std::string_view bytes);
  std::optional<BoardFrame> next();
  void clear() noexcept { bytes_.clear(); }
  std::uint64_t skipped_bytes() const noexcept { return skipped_bytes_; }

 private:
  void skip(std::size_t count);

  std::string bytes_;
  std::uint64_t skipped_bytes_ = 0;
};

}  // namespace glissade::bridges::dynamixel
