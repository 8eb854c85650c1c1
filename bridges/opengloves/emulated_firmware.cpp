#include "opengloves/emulated_firmware.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "hand/finger_curls.h"
#include "opengloves/line_codec.h"

namespace glissade::bridges {
namespace {

using std::chrono::nanoseconds;

constexpr std::size_t kBufferSize = 256;  // of the serial port of an ESP32

nanoseconds period_of(const OpenGlovesEmulatorOptions& options) {
  constexpr double kFastest_Hz = 1000.0;
  if (!(options.rate_Hz >= 1.0 && options.rate_Hz <= kFastest_Hz))
    throw std::invalid_argument("emulated glove: the rate must lie between 1 and 1000 Hz");
  if (options.full_scale < 1 || options.full_scale > kLargestNumber)
    throw std::invalid_argument("emulated glove: the largest number must lie between 1 and 65535");
  return nanoseconds(std::llround(1e9 / options.rate_Hz));
}

/// What the strings measure with the fingers at these curls.
FingerValues sums_at(const FingerValues& curls) {
  return devices::flexion_sums(angles_of(curls));
}

/// The firmware has seen the open hand and the fist, and scales to them.
FingerValues curls_of(const FingerValues& sums) {
  const FingerValues open = sums_at({0, 0, 0, 0, 0});
  const FingerValues closed = sums_at({1, 1, 1, 1, 1});
  FingerValues curls{};
  for (std::size_t f = 0; f < kFingers; ++f)
    curls[f] = std::clamp((sums[f] - open[f]) / (closed[f] - open[f]), 0.0, 1.0);
  return curls;
}

/// Where the strings become taut.
FingerValues taut_sums(const FingerNumbers& limits) {
  constexpr double kSlack_rad = std::numbers::pi;  // a servo at rest lets the finger go beyond the fist
  FingerValues curls{};
  for (std::size_t f = 0; f < kFingers; ++f)
    curls[f] = 1.0 - static_cast<double>(limits[f]) / kLargestLimit;
  FingerValues sums = sums_at(curls);
  for (std::size_t f = 0; f < kFingers; ++f)
    if (limits[f] == kFreeLimit) sums[f] += kSlack_rad;
  return sums;
}

}  // namespace

EmulatedFirmware::EmulatedFirmware(const OpenGlovesEmulatorOptions& options, std::shared_ptr<EmulatedHand> hand)
    : encoding_(options.encoding),
      full_scale_(options.full_scale),
      period_(period_of(options)),
      line_patience_(options.line_patience),
      hand_(std::move(hand)) {}

std::optional<nanoseconds> EmulatedFirmware::next_time() const {
  return next_;
}

void EmulatedFirmware::receive(std::string_view bytes, nanoseconds now) {
  const std::size_t room = kBufferSize - buffer_.size();
  state_.lost_bytes += bytes.size() - std::min(bytes.size(), room);
  buffer_ += bytes.substr(0, room);
  if (waits_for_line_ && read_line(now)) next_ = std::max(last_state_ + period_, now);
}

std::string EmulatedFirmware::send_until(nanoseconds now) {
  std::string bytes;
  while (next_ <= now) {
    last_state_ = next_;
    bytes += state_line_at(next_);
    const bool has_line = read_line(next_);
    waits_for_line_ = !has_line;
    next_ += has_line ? period_ : std::max(period_, line_patience_);
  }
  hand_->advance_to(now);
  state_.curls = curls_of(hand_->fingers().flexion_sums());
  return bytes;
}

std::string EmulatedFirmware::state_line_at(nanoseconds now) {
  hand_->advance_to(now);
  const FingerValues curls = curls_of(hand_->fingers().flexion_sums());
  FingerNumbers numbers{};
  for (std::size_t f = 0; f < kFingers; ++f)
    numbers[f] = static_cast<int>(std::lround(curls[f] * full_scale_));
  return state_line(encoding_, numbers, full_scale_);
}

/// Returns whether there was a line. One that fills the buffer without an end is dropped.
bool EmulatedFirmware::read_line(nanoseconds now) {
  const std::size_t end = buffer_.find('\n');
  if (end == std::string::npos) {
    if (buffer_.size() == kBufferSize) buffer_.clear();
    return false;
  }
  waits_for_line_ = false;
  obey(std::string_view(buffer_).substr(0, end), now);
  buffer_.erase(0, end + 1);
  state_.waiting_lines = std::count(buffer_.begin(), buffer_.end(), '\n');
  return true;
}

void EmulatedFirmware::obey(std::string_view line, nanoseconds now) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  const std::optional<FingerNumbers> limits = decode_limits(encoding_, line);
  if (!limits) {
    state_.other_lines += line.empty() ? 0 : 1;
    return;
  }
  ++state_.limit_lines;
  if (*limits != FingerNumbers{}) ++state_.stopping_lines;
  state_.limits = *limits;
  hand_->advance_to(now);
  hand_->fingers().set_strings(taut_sums(*limits));
}

}  // namespace glissade::bridges
