#pragma once

/// A haptic loop for Python. Its threads run no Python and never wait for the interpreter lock.

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <glissade/devices/haptic_state.h>
#include <glissade/haptics/haptic_server.h>
#include <glissade/haptics/recording.h>
#include <glissade/realtime/triple_buffer.h>
#include <glissade/simulation/simulation.h>

#include "gloves.h"
#include "running.h"

namespace glissade::python {

class Server final : public Running {
 public:
  /// Builds the simulation of the scene. `record`: a file, or empty.
  Server(const simulation::Scene& scene, std::vector<std::shared_ptr<Glove>> gloves, std::string record);
  ~Server() override { end(); }

  /// Starts the loop, once. The caller holds the interpreter lock. Throws std::invalid_argument for a glove in use, and
  /// what the constructors of the loop and the recorder throw.
  void start();
  /// Lets the forces fade, and ends the loop. Throws std::runtime_error if the recording is not whole.
  void stop();
  void end() noexcept override;
  void abandon() noexcept override;

  /// The loop. Throws std::runtime_error before the start.
  haptics::HapticServer& loop();
  /// Throws std::runtime_error, with the reason, if the loop has failed.
  void check() const;
  bool is_running() const noexcept { return phase_ == Phase::kRunning; }
  bool has_ended() const noexcept { return phase_ == Phase::kEnded; }

  /// The newest state. Any thread; never waits for the loop.
  devices::HapticState newest();
  /// Records that the recorder has lost, because the machine was busy.
  std::uint64_t lost_records() const noexcept { return lost_records_; }

  const simulation::Scene& scene() const noexcept { return scene_; }
  std::size_t glove_count() const noexcept { return gloves_.size(); }

 private:
  enum class Phase { kNew, kRunning, kEnding, kEnded };

  void record_to(const std::string& file);
  void end_loop();
  void show_end();

  simulation::Scene scene_;
  std::vector<std::shared_ptr<Glove>> gloves_;
  std::string record_;
  std::unique_ptr<simulation::Simulation> simulation_;
  Phase phase_ = Phase::kNew;  ///< the interpreter lock guards it
  std::uint64_t lost_records_ = 0;
  std::vector<std::shared_ptr<void>> claims_;  ///< until the loop has ended
  std::mutex end_mutex_;                       ///< of threads that end the loop
  std::mutex frame_mutex_;                     ///< of readers among each other
  realtime::TripleBuffer<devices::HapticState> frames_;
  std::unique_ptr<haptics::LogRecorder> recorder_;
  std::unique_ptr<haptics::BackgroundObserver> observer_;
  std::unique_ptr<haptics::HapticServer> loop_;
};

}  // namespace glissade::python
