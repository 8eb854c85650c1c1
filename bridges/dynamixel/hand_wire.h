#pragma once

/// The wire to a hand of Dynamixel servos, see `make_dynamixel_wire`.

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glissade/bridges/dynamixel_hand.h>
#include <glissade/bridges/release_guard.h>
#include <glissade/bridges/wire.h>

#include "dynamixel/driven_joint.h"
#include "dynamixel/measuring_board.h"
#include "dynamixel/servo_bus.h"
#include "dynamixel/servo_setup.h"

namespace glissade::bridges::dynamixel {

class DynamixelWire final : public DynamixelBusWire {
 public:
  DynamixelWire(const DynamixelHand& hand, std::shared_ptr<ByteStream> bus, std::shared_ptr<ByteStream> board,
                std::shared_ptr<realtime::Clock> clock);
  /// Releases.
  ~DynamixelWire() override { release(); }

  const devices::DeviceDescriptor& descriptor() const noexcept override { return descriptor_; }
  void open() override;
  bool read(devices::GloveState& state) override;
  void write(const devices::SafeCommand& command) override;
  void release() noexcept override;

  DynamixelTraffic traffic() const override;

 private:
  void guard_port();
  void wait_for_period();
  bool measure_servos();
  bool measure_board();
  void check_next_servo();
  void restart_watchdog(DrivenJoint& joint);
  [[noreturn]] void fail_by_hardware_error(const DrivenJoint& joint);
  [[noreturn]] void fail_by_silence(const std::vector<std::optional<Answer>>& answers);
  ServoAccess access(const DrivenJoint& joint) { return {bus_, joint.id, bus_line_->name()}; }

  DynamixelHand hand_;
  devices::DeviceDescriptor descriptor_;
  std::shared_ptr<ByteStream> bus_line_;
  std::shared_ptr<ByteStream> board_line_;
  std::shared_ptr<realtime::Clock> clock_;
  ServoBus bus_;
  std::optional<ReleaseGuard> guard_;  // of a port of the system
  std::vector<DrivenJoint> joints_;
  std::vector<std::uint8_t> ids_;
  BoardDecoder board_;
  std::array<double, kBoardChannels> board_angles_{};  // rad
  std::chrono::nanoseconds next_{0};                   // start of the next period
  std::chrono::nanoseconds measured_{0};               // last measurement of all servos
  std::chrono::nanoseconds board_measured_{0};         // arrival of the last frame of the board
  bool has_board_frame_ = false;
  int periods_to_check_ = 0;
  std::size_t next_checked_ = 0;
  std::uint64_t restarted_watchdogs_ = 0;
  bool is_free_ = true;
};

}  // namespace glissade::bridges::dynamixel
