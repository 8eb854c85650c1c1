#pragma once

/// Faults of a line, for any emulated device.

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <random>

#include <glissade/bridges/emulator.h>

#include "emulation/emulated_device.h"

namespace glissade::bridges {

/// The device behind a faulty line. The same seed gives the same faults.
class FaultyDevice final : public EmulatedDevice {
 public:
  FaultyDevice(std::shared_ptr<EmulatedDevice> device, std::uint64_t seed);

  void receive(std::string_view bytes, std::chrono::nanoseconds now) override;
  std::string send_until(std::chrono::nanoseconds now) override;
  std::optional<std::chrono::nanoseconds> next_time() const override;

  LineFaults faults;

 private:
  struct Late {
    std::chrono::nanoseconds time;
    std::string bytes;
  };

  bool happens(double share);
  std::string distorted(std::string bytes);

  std::shared_ptr<EmulatedDevice> device_;
  std::mt19937_64 random_;
  std::deque<Late> late_;
};

}  // namespace glissade::bridges
