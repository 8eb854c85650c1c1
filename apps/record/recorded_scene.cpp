#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include <glissade/apps/record/recorded_scene.h>
#include <glissade/apps/scene/embedded_scene.h>
#include <glissade/apps/view/session_view.h>

namespace glissade::apps {

HapticScene recorded_scene(const std::string& log_path, const RecordedSession& session, const std::string& scene_file) {
  const std::string& file = scene_file.empty() ? session.scene_file : scene_file;
  const bool has_fingers =
      std::any_of(session.hands.begin(), session.hands.end(), [](const RecordedHand& hand) { return hand.fingers; });
  const Scene scene = read_or_embedded_scene(file, has_fingers ? Demonstration::kDoorModule : Demonstration::kCarDoor);
  HapticScene result = make_haptic_scene(scene, movable_objects(scene));
  if (simulation::hash_of(result) == session.scene_hash) return result;
  throw std::invalid_argument(result.source + ": is not the scene of " + log_path +
                              ", or has changed since; name the file that has its scene");
}

viewer::ViewScene recorded_view(const std::string& log_path, const RecordedSession& session,
                                const std::string& scene_file) {
  std::vector<std::int64_t> devices;
  std::vector<std::shared_ptr<const grasping::HandModel>> models;
  for (const RecordedHand& hand : session.hands) {
    devices.push_back(hand.glove.device);
    models.push_back(hand.fingers ? std::make_shared<const grasping::HandModel>(grasping::make_hand(*hand.fingers))
                                  : nullptr);
  }
  return view_scene_of(recorded_scene(log_path, session, scene_file), glove_names(devices), models);
}

}  // namespace glissade::apps
