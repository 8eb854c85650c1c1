#pragma once

/// The firmware of LucidGloves, emulated.

#include <chrono>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include <glissade/bridges/opengloves_emulator.h>

#include "emulation/emulated_device.h"
#include "emulation/emulated_hand.h"

namespace glissade::bridges {

/// Sends a state, reads one line, and begins anew. Without a line, it waits for one. Bytes wait in a buffer of the
/// board; those that find no room in it are lost.
class EmulatedFirmware final : public EmulatedDevice {
 public:
  /// Throws std::invalid_argument if the rate or the largest number of `options` is out of range.
  EmulatedFirmware(const OpenGlovesEmulatorOptions& options, std::shared_ptr<EmulatedHand> hand);

  void receive(std::string_view bytes, std::chrono::nanoseconds now) override;
  std::string send_until(std::chrono::nanoseconds now) override;
  std::optional<std::chrono::nanoseconds> next_time() const override;

  const EmulatedGlove& state() const noexcept { return state_; }

 private:
  std::string state_line_at(std::chrono::nanoseconds now);
  bool read_line(std::chrono::nanoseconds now);
  void obey(std::string_view line, std::chrono::nanoseconds now);

  OpenGlovesEncoding encoding_;
  int full_scale_;
  std::chrono::nanoseconds period_;
  std::chrono::nanoseconds line_patience_;
  std::shared_ptr<EmulatedHand> hand_;
  EmulatedGlove state_;
  std::string buffer_;  // bytes that the firmware has not read
  std::chrono::nanoseconds last_state_{0};
  std::chrono::nanoseconds next_{0};  // of the next state, if no line ends the wait before
  bool waits_for_line_ = false;
};

}  // namespace glissade::bridges
