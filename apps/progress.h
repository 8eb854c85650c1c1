#pragma once

/// A progress bar for work that takes more than a second.

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace glissade::apps {

/// Adds the flag --quiet, with which no progress is shown.
void add_quiet_option(CLI::App& command);
/// Whether --quiet was given.
bool& is_quiet();

/// The amount of work that is done, in words, such as "1.20 of 6.00 s".
using AmountText = std::function<std::string(std::int64_t done, std::int64_t total)>;

/// Shows the progress of counted work on standard error. On a terminal, as a bar, once the work has taken a second; the
/// destructor erases it. Elsewhere, as a line after half a period and after each further period. Not thread-safe; may
/// block on standard error.
class ProgressBar {
 public:
  static constexpr std::chrono::milliseconds kLinePeriod = std::chrono::seconds(10);

  /// `total` > 0 is the amount of work. `amount`, if there is one, follows the bar. `line_period` is the period of
  /// lines, where there is no terminal.
  ProgressBar(std::string label, std::int64_t total, AmountText amount = {},
              std::chrono::milliseconds line_period = kLinePeriod);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Reports that `done` of `total` is done. Draws at most 10 times a second, so it is cheap enough for loops whose
  /// steps take microseconds.
  void update(std::int64_t done);
  /// Takes the bar away, so that something else can be written; the next update may draw it again.
  void erase();

 private:
  void draw(std::int64_t done);
  void tell(std::int64_t done);

  std::string label_;
  std::int64_t total_;
  AmountText amount_;
  std::chrono::milliseconds line_period_;
  bool on_terminal_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point next_draw_;
};

/// The line shown: the label, a bar of `width` cells and the percentage.
std::string progress_line(const std::string& label, std::int64_t done, std::int64_t total, int width);

/// The amount of a simulation whose work is counted in milliseconds.
std::string simulated_time(std::int64_t done_ms, std::int64_t total_ms);

}  // namespace glissade::apps
