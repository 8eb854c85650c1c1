#pragma once

/// A ByteStream to an emulated device in the same thread.

#include <memory>
#include <string>
#include <utility>

#include <glissade/bridges/byte_stream.h>
#include <glissade/bridges/wire.h>
#include <glissade/realtime/clock.h>

#include "emulation/emulated_device.h"

namespace glissade::bridges {

/// The device's time starts at 0 with the line. On a simulated clock, waiting for bytes lets the time pass. Devices on
/// other lines advance when their bytes are read.
class EmulatedLine final : public ByteStream {
 public:
  EmulatedLine(std::shared_ptr<EmulatedDevice> device, std::shared_ptr<realtime::Clock> clock)
      : device_(std::move(device)), clock_(std::move(clock)), start_(clock_->now()) {}

  std::string name() const override { return "an emulated line"; }
  void open() override {
    is_open_ = true;
    require_connection();
    device_->send_until(now());
  }
  void close() noexcept override { is_open_ = false; }
  bool is_open() const noexcept override { return is_open_; }
  int descriptor() const noexcept override { return -1; }
  void write(std::string_view bytes) override {
    require_connection();
    device_->receive(bytes, now());
  }
  std::string read(std::chrono::nanoseconds patience) override {
    require_connection();
    const std::chrono::nanoseconds deadline = now() + patience;
    while (true) {
      std::string bytes = device_->send_until(now());
      if (!bytes.empty() || now() >= deadline) return bytes;
      const std::optional<std::chrono::nanoseconds> next = device_->next_time();
      clock_->sleep_until(start_ + (next && *next < deadline ? *next : deadline));
    }
  }

  bool is_plugged = true;

 private:
  std::chrono::nanoseconds now() const noexcept { return clock_->now() - start_; }
  void require_connection() const {
    if (!is_plugged) throw WireError("The adapter of " + name() + " is not plugged in.");
    if (!is_open_) throw WireError("The line " + name() + " is closed.");
  }

  std::shared_ptr<EmulatedDevice> device_;
  std::shared_ptr<realtime::Clock> clock_;
  std::chrono::nanoseconds start_;
  bool is_open_ = false;
};

}  // namespace glissade::bridges
