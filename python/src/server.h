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

/// Writes a log that is opened after the loop has started. Until then, the thread that brings records waits.
class LateRecorder final : public haptics::LoopObserver {
 public:
  /// Makes records wait for as long as the result lives. Afterwards they are lost if `open` was not called.
  [[nodiscard]] std::unique_lock<std::mutex> hold() { return std::unique_lock(mutex_); }
  /// While records wait. Throws what the constructor of haptics::LogRecorder throws.
  void open(const std::string& file, haptics::RecordingHead head) { log_.emplace(file, std::move(head)); }
  /// After the last record. Throws what haptics::LogRecorder::close throws.
  void close() { log_->close(); }

  void after_tick(const haptics::TickRecord& record) noexcept override {
    const std::lock_guard lock(mutex_);
    if (log_) log_->after_tick(record);
  }
  void after_answer(const haptics::AnswerRecord& record) noexcept override {
    const std::lock_guard lock(mutex_);
    if (log_) log_->after_answer(record);
  }

 private:
  std::mutex mutex_;
  std::optional<haptics::LogRecorder> log_;
};

class Server final : public Running {
 public:
  /// Builds the simulation of the scene. `record`: a file, or empty.
  Server(const simulation::Scene& scene, std::vector<std::shared_ptr<Glove>> gloves, std::string record);
  ~Server() override { end(); }

  /// Starts the loop, once. The caller holds the interpreter lock. Throws std::invalid_argument for a glove in use, and
  /// what the constructors of the loop and the recorder throw; then it may be called again.
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
  enum class Phase { kNew, kStarting, kRunning, kEnding, kEnded };
  using Claims = std::vector<std::shared_ptr<void>>;
  using Hands = std::vector<haptics::HandInLoop<devices::GloveDevice>>;

  void start_loop(std::unique_lock<std::mutex> starting, Claims claims, const Hands& hands,
                  haptics::RecordingHead head);
  void end_loop();
  void show_end();
  bool has_loop() const noexcept { return phase_ > Phase::kStarting && loop_ != nullptr; }

  simulation::Scene scene_;
  std::vector<std::shared_ptr<Glove>> gloves_;
  std::string record_;
  std::unique_ptr<simulation::Simulation> simulation_;
  Phase phase_ = Phase::kNew;  ///< the interpreter lock guards it
  std::uint64_t lost_records_ = 0;
  Claims claims_;           ///< until the loop has ended
  std::mutex loop_mutex_;   ///< of threads that start or end the loop
  std::mutex frame_mutex_;  ///< of readers among each other
  realtime::TripleBuffer<devices::HapticState> frames_;
  // A start sets them without the interpreter lock, so only threads with `loop_mutex_` may read them meanwhile.
  std::unique_ptr<LateRecorder> recorder_;
  std::unique_ptr<haptics::BackgroundObserver> observer_;
  std::unique_ptr<haptics::HapticServer> loop_;
};

}  // namespace glissade::python
