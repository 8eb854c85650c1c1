#include <algorithm>
#include <iostream>
#include <utility>

#include <CLI/CLI.hpp>
#include <unistd.h>

#include <glissade/apps/progress.h>
#include <glissade/apps/text.h>

namespace glissade::apps {

namespace {

constexpr std::chrono::seconds kQuietTime{1};
constexpr std::chrono::milliseconds kRedrawPeriod{100};
constexpr int kBarWidth = 40;

}  // namespace

bool& is_quiet() {
  static bool quiet = false;
  return quiet;
}

void add_quiet_option(CLI::App& command) {
  command.add_flag("--quiet", is_quiet(), "Do not show the progress of long work");
}

ProgressBar::ProgressBar(std::string label, std::int64_t total, AmountText amount,
                         std::chrono::milliseconds line_period)
    : label_(std::move(label)),
      total_(total),
      amount_(std::move(amount)),
      line_period_(line_period),
      on_terminal_(isatty(STDERR_FILENO) == 1),
      next_draw_(std::chrono::steady_clock::now() + (on_terminal_ ? kQuietTime : line_period_ / 2)) {}

ProgressBar::~ProgressBar() {
  erase();
}

void ProgressBar::erase() {
  // Carriage return, then "erase to the end of the line".
  if (drawn_) std::cerr << "\r\033[K" << std::flush;
  drawn_ = false;
}

void ProgressBar::update(std::int64_t done) {
  if (is_quiet() || std::chrono::steady_clock::now() < next_draw_) return;
  if (on_terminal_) {
    draw(done);
  } else {
    tell(done);
  }
}

void ProgressBar::tell(std::int64_t done) {
  std::cerr << "glissade: " << label_ << ": " << std::clamp<std::int64_t>(done, 0, total_) * 100 / total_ << " %";
  if (amount_) std::cerr << ", " << amount_(done, total_);
  std::cerr << std::endl;
  next_draw_ = std::chrono::steady_clock::now() + line_period_;
}

void ProgressBar::draw(std::int64_t done) {
  std::cerr << '\r' << progress_line(label_, done, total_, kBarWidth);
  if (amount_) std::cerr << ", " << amount_(done, total_);
  std::cerr << std::flush;
  drawn_ = true;
  next_draw_ = std::chrono::steady_clock::now() + kRedrawPeriod;
}

std::string progress_line(const std::string& label, std::int64_t done, std::int64_t total, int width) {
  const std::int64_t within = std::clamp<std::int64_t>(done, 0, total);
  const auto filled = static_cast<std::size_t>(within * width / total);
  const std::string percent = std::to_string(within * 100 / total);
  return label + " [" + std::string(filled, '#') + std::string(static_cast<std::size_t>(width) - filled, ' ') + "] " +
         std::string(3 - percent.size(), ' ') + percent + " %";
}

std::string simulated_time(std::int64_t done_ms, std::int64_t total_ms) {
  const auto seconds = [](std::int64_t ms) { return fixed_text(1e-3 * static_cast<double>(ms), 3); };
  return seconds(std::min(done_ms, total_ms)) + " of " + seconds(total_ms) + " s simulated";
}

}  // namespace glissade::apps
