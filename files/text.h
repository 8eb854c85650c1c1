#pragma once

/// Text helpers shared by the file readers and the error messages.

#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

namespace glissade::files {

/// The value of `text` if the whole text is a number, with a decimal point in any locale; otherwise std::nullopt.
/// "inf", "nan" and values beyond the range of a double do not count as numbers.
std::optional<double> parse_number(std::string_view text);

/// The shortest decimal text that reads back as exactly `value`, including the sign of zero.
std::string exact_number(double value);

/// Like `exact_number`, for people and tables: zero has no sign.
std::string format_number(double value);

/// `value` with `decimals` digits after the point. A value that rounds to zero has no sign.
std::string fixed_text(double value, int decimals);

/// `value` for messages, with three significant digits, but with all digits before the point: 12.3, 0.00123, 1523.
std::string rounded_text(double value);

/// `text` in single quotes, fit for a one-line message: control characters are replaced and long texts cut short.
std::string in_quotes(std::string_view text);

/// `text` on one line: runs of line breaks and other control characters become one space.
std::string one_line(std::string_view text);

/// The texts, with a separator between each text and the next.
template <typename Texts>
std::string joined(const Texts& texts, std::string_view separator = ", ") {
  std::string result;
  for (const auto& text : texts) {
    if (!result.empty()) result += separator;
    result += text;
  }
  return result;
}

/// 16 hexadecimal digits.
std::string hexadecimal(std::uint64_t number);

}  // namespace glissade::files
