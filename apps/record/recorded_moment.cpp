#include <filesystem>
#include <optional>
#include <stdexcept>

#include <glissade/apps/progress.h>
#include <glissade/apps/record/recorded_moment.h>
#include <glissade/apps/record/recorded_scene.h>
#include <glissade/apps/record/recorded_session.h>
#include <glissade/apps/text.h>
#include <glissade/devices/event_log.h>
#include <glissade/viewer/view_frame.h>

namespace glissade::apps {

namespace {

std::string seconds_text(std::chrono::nanoseconds time) {
  return format_number(std::chrono::duration<double>(time).count()) + " s";
}

devices::HapticState state_after(std::chrono::nanoseconds after, devices::EventLogReader& log,
                                 const std::string& log_path) {
  ProgressBar progress("log", static_cast<std::int64_t>(std::filesystem::file_size(log_path)));
  std::int64_t bytes = 0;
  std::optional<std::chrono::nanoseconds> start;
  std::optional<devices::HapticState> last;
  while (const std::optional<devices::LogEvent> event = log.next()) {
    bytes += std::ssize(event->message);
    progress.update(bytes);
    const std::optional<devices::HapticState> state = devices::haptic_state_of(*event);
    if (!state) continue;
    if (!start) start = state->time;
    if (last && state->time - *start > after) return *last;
    last = state;
  }
  if (last && after <= last->time - *start) return *last;
  if (!log.damage().empty()) throw std::runtime_error(log.damage());
  if (!last) throw std::invalid_argument(log_path + ": has no HAPTIC_STATE");
  throw std::invalid_argument("--at: " + seconds_text(after) + " is beyond the log " + log_path + ", which lasts " +
                              seconds_text(last->time - *start));
}

}  // namespace

viewer::ViewScene recorded_moment(const std::string& log_path, const std::string& scene_file,
                                  std::chrono::nanoseconds after) {
  if (after < std::chrono::nanoseconds(0))
    throw std::invalid_argument("--at: " + seconds_text(after) + " is before the log " + log_path + " begins");
  devices::EventLogReader log(log_path);
  const RecordedSession session = read_session(log, log_path);
  viewer::ViewScene scene = recorded_view(log_path, session, scene_file);
  const devices::HapticState state = state_after(after, log, log_path);
  for (viewer::ViewObject& object : scene.objects) {
    if (object.part) object.X_WB = state.parts.at(*object.part).X_WV;
  }
  for (std::size_t h = 0; h < scene.hands.size(); ++h) {
    viewer::ViewHand& hand = scene.hands[h];
    const devices::VisibleHand& visible = state.hands.at(h).visible;
    if (!devices::is_present(visible.activity)) hand.model = nullptr;
    if (!hand.model) continue;
    hand.X_WL.resize(hand.model->chain.links().size());
    hand.model->chain.poses(visible.X_WH, visible.angles, hand.X_WL);
  }
  return scene;
}

}  // namespace glissade::apps
