#pragma once

/// A line on a terminal that is renewed while something runs, and sentences between.

#include <string>
#include <string_view>

#include <unistd.h>

namespace glissade::apps {

/// The last line of a terminal. Without a terminal, only sentences are written. Nothing makes the program wait: where a
/// terminal or a pipe is full or stopped, text is left out. One thread.
class StatusLine {
 public:
  explicit StatusLine(int descriptor = STDERR_FILENO);
  /// Erases the line.
  ~StatusLine();
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  /// Shows `text` in place of the line, cut to the width of the terminal; an empty text erases it.
  void show(std::string_view text);
  /// Writes a sentence above the line.
  void say(std::string_view sentence);

 private:
  void write_to_terminal(const std::string& text) const;

  int descriptor_;
  int terminal_ = -1;  // -1: none
  std::string shown_;
};

/// The first `columns` characters of a text in UTF-8.
std::string_view cut_to_width(std::string_view text, std::size_t columns);

}  // namespace glissade::apps
