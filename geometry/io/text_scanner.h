#pragma once

/// Readers of text by lines and words, with line numbers for messages.

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdlib>
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

/// Splits a text into lines, which may end in LF or CR LF.
class LineScanner {
 public:
  explicit LineScanner(std::string_view text) : rest_(text) {}

  // Advances to the next line; false at the end of the text.
  bool next() {
    if (rest_.empty()) return false;
    const std::size_t end = rest_.find('\n');
    line_ = rest_.substr(0, end);
    rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
    if (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
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

/// Splits a text into words, across its lines.
class WordScanner {
 public:
  explicit WordScanner(std::string_view text) : lines_(text) {}

  // Whether there is another word; if so, `lines()` is at its line.
  bool has_word() {
    while (next_ >= words_.size()) {
      if (!lines_.next()) return false;
      split(lines_.line(), words_);
      next_ = 0;
    }
    return true;
  }
  // Only after has_word().
  std::string_view word() { return words_[next_++]; }
  void skip_line() { next_ = words_.size(); }
  const LineScanner& lines() const { return lines_; }

 private:
  LineScanner lines_;
  std::vector<std::string_view> words_;
  std::size_t next_ = 0;
};

/// The whole word as a number, "nan" and "inf" included; nothing if it is not a number. A value too large for a double
/// counts as infinite, a value too small as zero.
inline std::optional<double> parse_number(std::string_view word) {
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

inline std::optional<std::int64_t> parse_integer(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || error != std::errc{}) return std::nullopt;
  return value;
}

}  // namespace glissade::geometry
