#pragma once

/// The lines of OpenGloves gloves in both encodings.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <glissade/bridges/opengloves.h>

namespace glissade::bridges {

/// Whole numbers, from the thumb to the little finger.
using FingerNumbers = std::array<int, kFingers>;

/// No number of a glove is larger; a longer one is garbage.
inline constexpr int kLargestNumber = 65535;

/// A limit of this value leaves the finger free; the largest one keeps it open. A finger with the limit v closes up to
/// the curl 1 − v / 1000.
inline constexpr int kFreeLimit = 0;
inline constexpr int kLargestLimit = 1000;

/// What a glove says in one line. Splay and buttons other than `grab` are not used.
struct GloveLine {
  OpenGlovesEncoding encoding = OpenGlovesEncoding::kAlpha;
  FingerNumbers flexion{};
  std::optional<int> joystick;  ///< its first coordinate
  bool grab = false;            ///< the gesture or button of a hand that closes
  int numbers = 0;              ///< how many numbers the line has
};

/// The meaning of a line without its line break; no value if it is no whole line of a glove: a character or a key that
/// does not belong there, a key twice, a number that is missing or too large, or a finger that is missing.
std::optional<GloveLine> decode_line(std::string_view line);

/// The line, with its line break, that sets the limits of all fingers. A glove may take a missing one for any number.
std::string limit_line(OpenGlovesEncoding encoding, const FingerNumbers& limits);

/// The other end, for the emulator.
std::string state_line(OpenGlovesEncoding encoding, const FingerNumbers& flexion, int full_scale);
/// The limits in a line from the host; no value if the firmware ignores the line, or if a finger is missing.
std::optional<FingerNumbers> decode_limits(OpenGlovesEncoding encoding, std::string_view line);

/// Cuts bytes into lines. Lines longer than a glove's are dropped, up to their line break.
class LineCutter {
 public:
  /// Calls `use` with each line, without its line break, that `bytes` end.
  template <typename Use>
  void take(std::string_view bytes, const Use& use) {
    for (const char byte : bytes) {
      if (byte != '\n') {
        add(byte);
        continue;
      }
      if (!is_too_long_) use(std::string_view(line_));
      line_.clear();
      is_too_long_ = false;
    }
  }

 private:
  void add(char byte) {
    constexpr std::size_t kLongest = 256;
    is_too_long_ = is_too_long_ || line_.size() == kLongest;
    if (!is_too_long_ && byte != '\r') line_ += byte;
  }

  std::string line_;
  bool is_too_long_ = false;
};

/// Finds the states of a glove among bytes that may have gaps, garbage and echoes of what was sent.
///
/// The wire has no checksum. A line with fewer numbers than the ones before has lost some, or is an echo, whose limits
/// look like five fingers: it counts only if twenty such lines follow each other.
class GloveDecoder {
 public:
  /// Takes bytes as they come. The newest state among the lines that they end.
  std::optional<GloveLine> take(std::string_view bytes);

  std::uint64_t bytes() const noexcept { return bytes_; }
  std::uint64_t states() const noexcept { return states_; }
  /// Lines that were no states.
  std::uint64_t refused() const noexcept { return refused_; }
  /// The last of them.
  const std::string& last_refused() const noexcept { return last_refused_; }

 private:
  bool is_whole(const GloveLine& line) noexcept;

  LineCutter lines_;
  int most_numbers_ = 0;
  int poorer_in_row_ = 0;
  std::uint64_t bytes_ = 0;
  std::uint64_t states_ = 0;
  std::uint64_t refused_ = 0;
  std::string last_refused_;
};

}  // namespace glissade::bridges
