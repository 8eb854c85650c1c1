#include <optional>
#include <stdexcept>

#include <glissade/apps/record/log_file.h>
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

/// In the run whose session has been read.
devices::HapticState state_after(std::chrono::nanoseconds after, LogFile& log) {
  std::optional<std::chrono::nanoseconds> start;
  std::optional<devices::HapticState> last;
  while (const std::optional<devices::LogEvent> event = log.next()) {
    if (event->channel == kHapticSessionChannel) break;
    const std::optional<devices::HapticState> state = devices::haptic_state_of(*event);
    if (!state) continue;
    if (!start) start = state->time;
    if (last && state->time - *start > after) return *last;
    last = state;
  }
  if (last && after <= last->time - *start) return *last;
  if (!log.damage().empty()) throw std::runtime_error(log.damage());
  if (!last) throw std::invalid_argument(log.path() + ": has no HAPTIC_STATE");
  throw std::invalid_argument("--at: " + seconds_text(after) + " is beyond the log " + log.path() + ", which lasts " +
                              seconds_text(last->time - *start));
}

}  // namespace

viewer::ViewScene recorded_moment(const std::string& log_path, const std::string& scene_file,
                                  std::chrono::nanoseconds after) {
  if (after < std::chrono::nanoseconds(0))
    throw std::invalid_argument("--at: " + seconds_text(after) + " is before the log " + log_path + " begins");
  LogFile log(log_path, "log");
  const RecordedSession session = first_session(log);
  viewer::ViewScene scene = recorded_view(log_path, session, scene_file);
  const devices::HapticState state = state_after(after, log);
  for (viewer::ViewObject& object : scene.objects) {
    if (object.part) object.X_WB = state.parts.at(*object.part).X_WV;
  }
  for (std::size_t h = 0; h < scene.hands.size(); ++h) {
    viewer::ViewHand& hand = scene.hands[h];
    const hands::VisibleHand& visible = state.hands.at(h).visible;
    if (!hands::is_present(visible.activity)) hand.model = nullptr;
    if (!hand.model) continue;
    hand.X_WL.resize(hand.model->chain.links().size());
    hand.model->chain.poses(visible.X_WH, visible.angles, hand.X_WL);
  }
  return scene;
}

}  // namespace glissade::apps
