#include <algorithm>
#include <thread>
#include <utility>

#include <glissade/apps/record/replay_audiences.h>
#include <glissade/apps/run/stop_signal.h>
#include <glissade/apps/say.h>
#include <glissade/apps/view/session_view.h>

namespace glissade::apps {

void ReplayView::begin(const HapticScene& scene, const SlidingChoice& /*choice*/, std::chrono::nanoseconds /*period*/,
                       const std::vector<std::int64_t>& devices,
                       const std::vector<std::shared_ptr<const grasping::HandModel>>& models) {
  start_.reset();
  server_.reset();  // that of the run before has the port
  server_ = open_view(view_scene_of(scene, glove_names(devices), models), port_);
  say("glissade replay: open " + server_->url() + " in a browser: then it starts");
  while (!server_->has_had_client() && !StopSignal::requested())
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

bool ReplayView::take(const devices::HapticState& state) {
  if (!start_) {
    start_ = std::chrono::steady_clock::now();
    first_ = state.time;
  }
  // In slices: a log may say anything, and Ctrl-C must wake it.
  constexpr std::chrono::milliseconds kSlice{50};
  const auto wanted = *start_ + (state.time - first_);
  while (std::chrono::steady_clock::now() < wanted && !StopSignal::requested())
    std::this_thread::sleep_until(std::min(wanted, std::chrono::steady_clock::now() + kSlice));
  server_->push(state);
  return !StopSignal::requested();
}

void ReplayReport::begin(const HapticScene& scene, const SlidingChoice& choice, std::chrono::nanoseconds period,
                         const std::vector<std::int64_t>& devices,
                         const std::vector<std::shared_ptr<const grasping::HandModel>>& models) {
  const auto minute = static_cast<std::size_t>(std::chrono::minutes(1) / period);
  scene_ = scene;
  session_ = {};
  samples_ = std::make_shared<SessionRecorder>(minute, scene.parts.size() + scene.moving.size(), devices.size());
  session_.choice = choice;
  session_.period = period;
  session_.objects = std::ssize(scene.body_names);
  session_.devices = devices;
  session_.hand_models = models;
  session_.samples = samples_;
}

bool ReplayReport::take(const devices::HapticState& state) {
  samples_->record(state);
  ++session_.ticks;
  return true;
}

std::string ReplayReport::write(const std::string& folder) const {
  return write_session_report(summarize(session_, *scene_), session_, title_, folder, *scene_);
}

}  // namespace glissade::apps
