#pragma once

/// What a run does with the state of each tick: recorder, viewers and the user get it.

#include <memory>
#include <utility>

#include <glissade/apps/run/run_watch.h>
#include <glissade/apps/run/session.h>
#include <glissade/devices/haptic_state.h>
#include <glissade/devices/lcm_bus.h>
#include <glissade/viewer/view_server.h>

namespace glissade::apps {

class SessionSink {
 public:
  /// `watch` must outlive the sink, and so must `view`, which may be null.
  SessionSink(const std::shared_ptr<devices::LcmBus>& bus, std::shared_ptr<SessionRecorder> recorder, RunWatch& watch,
              viewer::ViewServer* view)
      : recorder_(std::move(recorder)), publisher_(bus, listener_of(view)), watch_(watch) {}

  /// In the haptic thread. Wait-free, no allocation.
  void receive(const devices::HapticState& sample) noexcept {
    recorder_->record(sample);
    publisher_.push(sample);
    watch_.note(sample);
  }

 private:
  /// From the publisher's thread: a ring of its own would cost the haptic thread another copy of each state.
  static devices::HapticStatePublisher::Listener listener_of(viewer::ViewServer* view) {
    if (view == nullptr) return {};
    return [view](const devices::HapticState& state) { view->push(state); };
  }

  std::shared_ptr<SessionRecorder> recorder_;
  devices::HapticStatePublisher publisher_;
  RunWatch& watch_;
};

}  // namespace glissade::apps
