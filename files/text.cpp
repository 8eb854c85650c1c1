#include <array>
#include <charconv>
#include <cmath>
#include <system_error>

#include <glissade/files/text.h>

namespace glissade::files {

namespace {

bool is_control(char character) {
  const auto byte = static_cast<unsigned char>(character);
  return byte < 0x20 || byte == 0x7f;
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string exact_number(double value) {
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

std::string format_number(double value) {
  return exact_number(value + 0.0);
}

std::string fixed_text(double value, int decimals) {
  std::array<char, 400> buffer{};  // the largest double has 309 digits before the point
  const auto result =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, decimals);
  const std::string text(buffer.data(), result.ptr);
  return text.starts_with('-') && text.find_first_of("123456789") == std::string::npos ? text.substr(1) : text;
}

std::string rounded_text(double value) {
  constexpr int kDigits = 3;
  constexpr double kShort = 999.5;   // has more digits before the point, once rounded
  constexpr double kLargest = 1e15;  // whose digits before the point are all known
  const double size = std::abs(value);
  if (size >= kShort && size < kLargest) return fixed_text(value, 0);
  std::array<char, 32> buffer{};
  const auto result =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value + 0.0, std::chars_format::general, kDigits);
  return {buffer.data(), result.ptr};
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  const bool cut = text.size() > kLongest;
  return "'" + one_line(text.substr(0, kLongest)) + (cut ? "...'" : "'");
}

std::string one_line(std::string_view text) {
  std::string result;
  bool in_run = false;
  for (const char character : text) {
    const bool control = is_control(character);
    if (!control) result += character;
    if (control && !in_run) result += ' ';
    in_run = control;
  }
  return result;
}

std::string hexadecimal(std::uint64_t number) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4)
    text += kDigits[(number >> shift) & 15U];
  return text;
}

}  // namespace glissade::files
