#pragma once

/// Faults of a line, for any emulated device.

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <random>

#include "dynamixel/emulated_device.h"

namespace glissade::bridges::dynamixel {

/// What may happen to the bytes of one answer or frame. Shares are from 0 to 1.
struct LineFaults {
  double garbage = 0.0;                  ///< share that follows up to 20 random bytes
  double cut = 0.0;                      ///< share of which only a first part arrives
  double flipped_bit = 0.0;              ///< share with one wrong bit
  bool has_echo = false;                 ///< the host hears its own bytes
  std::chrono::nanoseconds slowness{0};  ///< added to the time of all bytes
};

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

}  // namespace glissade::bridges::dynamixel
