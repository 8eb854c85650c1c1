#pragma once

/// Readers of text by lines and words, with line numbers for messages.

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace glissade::geometry {

inline constexpr std::string_view kBlanks = " \t\r\v\f";

/// The text without the byte-order mark of UTF-8, which some editors and exporters put before it.
inline std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  return text.starts_with(kMark) ? text.substr(kMark.size()) : text;
}

/// Splits a text into lines, which end in LF, CR LF or CR.
class LineScanner {
 public:
  explicit LineScanner(std::string_view text) : rest_(text) {}

  // Advances to the next line; false at the end of the text.
  bool next() {
    if (rest_.empty()) return false;
    const auto* const end = std::find_if(rest_.begin(), rest_.end(), [](char c) { return c == '\n' || c == '\r'; });
    line_ = rest_.substr(0, static_cast<std::size_t>(end - rest_.begin()));
    rest_.remove_prefix(line_.size());
    rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : std::min<std::size_t>(1, rest_.size()));
    ++number_;
    return true;
  }
  std::string_view line() const { return line_; }
  // Counted from 1.
  std::int64_t number() const { return number_; }
  std::string where() const { return "line " + std::to_string(number_); }
  // The text after the current line.
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  std::string_view line_;
  std::int64_t number_ = 0;
};

/// Replaces `words` by the words of `line`, which are separated by blanks.
inline void split(std::string_view line, std::vector<std::string_view>& words) {
  words.clear();
  for (std::size_t begin = line.find_first_not_of(kBlanks); begin != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kBlanks, end);
  }
}

/// Splits a text into words, across its lines. A copy looks ahead.
class WordScanner {
 public:
  explicit WordScanner(std::string_view text) : lines_(text) {}

  // Whether there is another word; if so, `lines()` is at its line.
  bool has_word() {
    while (!has_word_in_line()) {
      if (!lines_.next()) return false;
      rest_of_line_ = lines_.line();
    }
    return true;
  }
  bool has_word_in_line() {
    rest_of_line_.remove_prefix(std::min(rest_of_line_.find_first_not_of(kBlanks), rest_of_line_.size()));
    return !rest_of_line_.empty();
  }
  // Only after has_word().
  std::string_view word() {
    const std::string_view word = rest_of_line_.substr(0, rest_of_line_.find_first_of(kBlanks));
    rest_of_line_.remove_prefix(word.size());
    return word;
  }
  std::string_view rest_of_line() const { return rest_of_line_; }
  void skip_line() { rest_of_line_ = {}; }
  const LineScanner& lines() const { return lines_; }

 private:
  LineScanner lines_;
  std::string_view rest_of_line_;
};

/// Whether the word stands for NaN or infinity, as old C libraries write them: "-1.#IND", "1.#QNAN0", "1.#INF".
inline bool is_old_nan(std::string_view word) {
  if (word.starts_with('+') || word.starts_with('-')) word.remove_prefix(1);
  if (!word.starts_with("1.#")) return false;
  word.remove_prefix(3);
  while (!word.empty() && word.back() == '0') {
    word.remove_suffix(1);
  }
  return word == "IND" || word == "INF" || word == "QNAN" || word == "SNAN" || word == "NAN";
}

/// The whole word as a number, "nan" and "inf" included; nothing if it is not a number. A value too large for a double
/// counts as infinite, a value too small as zero.
inline std::optional<double> parse_number(std::string_view word) {
  if (is_old_nan(word)) return std::numeric_limits<double>::quiet_NaN();
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || word.empty()) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    // Unlike from_chars, strtod distinguishes overflow from underflow.
    return std::strtod(std::string(word).c_str(), nullptr);
  }
  if (error != std::errc{}) return std::nullopt;
  return value;
}

/// The beginning of a text of the file, fit for a message.
inline std::string printable(std::string_view text) {
  std::string result(text.substr(0, 40));
  std::replace_if(
      result.begin(), result.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return result;
}

inline std::optional<std::int64_t> parse_integer(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || error != std::errc{}) return std::nullopt;
  return value;
}

}  // namespace glissade::geometry
