#pragma once

/// The measuring board of the DOGlove, emulated.

#include <array>
#include <chrono>
#include <functional>
#include <utility>

#include "dynamixel/measuring_board.h"
#include "emulation/emulated_device.h"

namespace glissade::bridges::dynamixel {

/// Sends a frame each period, without being asked, and ignores what it gets.
class EmulatedBoard final : public EmulatedDevice {
 public:
  using Angles = std::array<double, kBoardChannels>;

  /// `angles` returns the angles of the potentiometers (rad) at the time of a frame.
  EmulatedBoard(std::function<Angles(std::chrono::nanoseconds)> angles, std::chrono::nanoseconds period)
      : angles_(std::move(angles)), period_(period), next_(period) {}

  void receive(std::string_view, std::chrono::nanoseconds) override {}
  std::string send_until(std::chrono::nanoseconds now) override {
    std::string bytes;
    for (; next_ <= now; next_ += period_)
      bytes += encode(frame());
    return bytes;
  }
  std::optional<std::chrono::nanoseconds> next_time() const override { return next_; }

 private:
  BoardFrame frame() const {
    constexpr std::uint32_t kReference_uV = 3'300'000;
    const Angles angles = angles_(next_);
    BoardFrame result{.reference_uV = kReference_uV,
                      .time_stamp = static_cast<std::uint16_t>(next_ / std::chrono::milliseconds(1) % 65536)};
    for (std::size_t i = 0; i < kBoardChannels; ++i)
      result.words[i] = board_word(angles[i], kReference_uV);
    return result;
  }

  std::function<Angles(std::chrono::nanoseconds)> angles_;
  std::chrono::nanoseconds period_;
  std::chrono::nanoseconds next_;
};

}  // namespace glissade::bridges::dynamixel
