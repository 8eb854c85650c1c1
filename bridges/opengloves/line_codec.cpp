#include "opengloves/line_codec.h"

#include <algorithm>
#include <charconv>

namespace glissade::bridges {
namespace {

constexpr std::string_view kFingerKeys = "ABCDE";

/// Takes digits off the front of `text`; no value if there are none, or the number is too large.
std::optional<int> take_number(std::string_view& text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.starts_with('-') || error != std::errc{} || number > kLargestNumber) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

/// Takes a letter, or letters in parentheses, off the front of `text`. Empty if there is none.
std::string_view take_key(std::string_view& text) {
  const auto is_key = [](char c) { return 'A' <= c && c <= 'Z'; };
  std::size_t size = is_key(text[0]) ? 1 : 0;
  if (text[0] == '(') {
    size = text.find(')') + 1;  // 0 if there is none
    for (std::size_t i = 1; i + 1 < size; ++i)
      if (!is_key(text[i])) size = 0;
  }
  const std::string_view key = text.substr(0, size);
  text.remove_prefix(size);
  return key;
}

std::optional<GloveLine> decode_alpha(std::string_view text) {
  constexpr std::string_view kFlags = "HIJKLMNO";
  constexpr std::string_view kNumbers = "ABCDEFGP";
  GloveLine line;
  std::uint32_t seen = 0;
  while (!text.empty()) {
    const std::string_view key = take_key(text);
    if (key.empty()) return std::nullopt;
    if (key.size() == 1) {
      const std::uint32_t bit = 1U << (key[0] - 'A');
      if ((seen & bit) != 0) return std::nullopt;
      seen |= bit;
    }
    if (key.size() == 1 && kFlags.find(key[0]) != std::string_view::npos) {
      line.grab = line.grab || key[0] == 'L';
      continue;
    }
    if (key.size() == 1 && kNumbers.find(key[0]) == std::string_view::npos) return std::nullopt;
    const std::optional<int> number = take_number(text);
    if (!number) return std::nullopt;
    ++line.numbers;
    const std::size_t finger = key.size() == 1 ? kFingerKeys.find(key[0]) : std::string_view::npos;
    if (finger != std::string_view::npos) line.flexion[finger] = *number;
    if (key == "F") line.joystick = number;
  }
  constexpr std::uint32_t kAllFingers = 0x1F;
  if ((seen & kAllFingers) != kAllFingers) return std::nullopt;
  return line;
}

/// Numbers between "&"; no value if there are others than `count`.
template <std::size_t count>
std::optional<std::array<int, count>> decode_numbers(std::string_view text) {
  std::array<int, count> numbers{};
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) {
      if (!text.starts_with('&')) return std::nullopt;
      text.remove_prefix(1);
    }
    const std::optional<int> number = take_number(text);
    if (!number) return std::nullopt;
    numbers[i] = *number;
  }
  if (!text.empty()) return std::nullopt;
  return numbers;
}

std::optional<GloveLine> decode_legacy(std::string_view text) {
  constexpr std::size_t kNumbers = 13;
  constexpr std::size_t kJoystick = 5;
  constexpr std::size_t kGrab = 11;
  const auto numbers = decode_numbers<kNumbers>(text);
  if (!numbers) return std::nullopt;
  GloveLine line;
  line.encoding = OpenGlovesEncoding::kLegacy;
  std::copy_n(numbers->begin(), kFingers, line.flexion.begin());
  line.joystick = (*numbers)[kJoystick];
  line.grab = (*numbers)[kGrab] != 0;
  line.numbers = kNumbers;
  return line;
}

std::string finger_numbers(OpenGlovesEncoding encoding, const FingerNumbers& numbers) {
  std::string text;
  for (std::size_t f = 0; f < kFingers; ++f) {
    if (encoding == OpenGlovesEncoding::kAlpha) text += kFingerKeys[f];
    if (encoding == OpenGlovesEncoding::kLegacy && f > 0) text += '&';
    text += std::to_string(numbers[f]);
  }
  return text;
}

}  // namespace

std::optional<GloveLine> decode_line(std::string_view line) {
  if (line.empty()) return std::nullopt;
  return line.find('&') == std::string_view::npos ? decode_alpha(line) : decode_legacy(line);
}

std::string limit_line(OpenGlovesEncoding encoding, const FingerNumbers& limits) {
  return finger_numbers(encoding, limits) + '\n';
}

std::string state_line(OpenGlovesEncoding encoding, const FingerNumbers& flexion, int full_scale) {
  const std::string middle = std::to_string(full_scale / 2);  // of a joystick that nobody touches
  const std::string fingers = finger_numbers(encoding, flexion);
  if (encoding == OpenGlovesEncoding::kAlpha) return fingers + "F" + middle + "G" + middle + "P0\n";
  return fingers + "&" + middle + "&" + middle + "&0&0&0&0&0&0\n";
}

std::optional<FingerNumbers> decode_limits(OpenGlovesEncoding encoding, std::string_view line) {
  constexpr std::size_t kShortest = 5;  // the firmware ignores less
  if (line.size() < kShortest) return std::nullopt;
  if (encoding == OpenGlovesEncoding::kLegacy) return decode_numbers<kFingers>(line);
  const std::optional<GloveLine> limits = decode_alpha(line);
  if (!limits) return std::nullopt;
  return limits->flexion;
}

std::optional<GloveLine> GloveDecoder::take(std::string_view bytes) {
  bytes_ += bytes.size();
  std::optional<GloveLine> newest;
  lines_.take(bytes, [&](std::string_view text) {
    const std::optional<GloveLine> line = decode_line(text);
    if (line && is_whole(*line)) {
      ++states_;
      newest = line;
    } else if (!text.empty()) {
      ++refused_;
      last_refused_ = text;
    }
  });
  return newest;
}

bool GloveDecoder::is_whole(const GloveLine& line) noexcept {
  constexpr int kOtherGlove = 20;
  const bool is_poorer = line.numbers < most_numbers_;
  poorer_in_row_ = is_poorer ? poorer_in_row_ + 1 : 0;
  if (is_poorer && poorer_in_row_ < kOtherGlove) return false;
  most_numbers_ = line.numbers;
  poorer_in_row_ = 0;
  return true;
}

}  // namespace glissade::bridges
