#pragma once

/// What a run does with the state of each tick: recorder, viewers and the user get it.

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <glissade/apps/reason_teller.h>
#include <glissade/apps/session.h>
#include <glissade/devices/haptic_state.h>
#include <glissade/devices/haptic_state_publisher.h>
#include <glissade/devices/lcm_bus.h>

namespace glissade::apps {

class SessionSink {
 public:
  SessionSink(const std::shared_ptr<devices::LcmBus>& bus, std::shared_ptr<SessionRecorder> recorder)
      : recorder_(std::move(recorder)), publisher_(bus), tellers_(recorder_->hands()) {}

  /// In the haptic thread. Wait-free, no allocation.
  void receive(const devices::HapticState& sample) noexcept {
    recorder_->record(sample);
    publisher_.push(sample);
    for (std::size_t h = 0; h < tellers_.size(); ++h)
      tellers_[h].note(sample, h);
  }

  /// As `ReasonTeller::news`, of the hand with this number.
  std::string news(std::size_t hand) { return tellers_[hand].news(); }

 private:
  std::shared_ptr<SessionRecorder> recorder_;
  devices::HapticStatePublisher publisher_;
  std::vector<ReasonTeller> tellers_;
};

}  // namespace glissade::apps
