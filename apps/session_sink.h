#pragma once

/// What a run does with the state of each tick: recorder, viewers and the user get it.

#include <memory>
#include <utility>

#include <glissade/apps/run_watch.h>
#include <glissade/apps/session.h>
#include <glissade/devices/haptic_state.h>
#include <glissade/devices/haptic_state_publisher.h>
#include <glissade/devices/lcm_bus.h>
#include <glissade/viewer/view_server.h>

namespace glissade::apps {

class SessionSink {
 public:
  /// `watch` must outlive the sink, and so must `view`, which may be null.
  SessionSink(const std::shared_ptr<devices::LcmBus>& bus, std::shared_ptr<SessionRecorder> recorder, RunWatch& watch,
              viewer::ViewServer* view)
      : recorder_(std::move(recorder)), publisher_(bus), watch_(watch), view_(view) {}

  /// In the haptic thread. Wait-free, no allocation.
  void receive(const devices::HapticState& sample) noexcept {
    recorder_->record(sample);
    publisher_.push(sample);
    watch_.note(sample);
    if (view_ != nullptr) view_->push(sample);
  }

 private:
  std::shared_ptr<SessionRecorder> recorder_;
  devices::HapticStatePublisher publisher_;
  RunWatch& watch_;
  viewer::ViewServer* view_;
};

}  // namespace glissade::apps
