#include <stdexcept>

#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/apps/text.h>
#include <glissade/apps/wait_notice.h>
#include <glissade/viewer/view_simulation.h>

namespace glissade::apps {

HapticScene make_haptic_scene(const Scene& scene, const std::vector<std::string>& part_names) {
  const WaitNotice notice("preparing the meshes of " + scene.source);
  HapticScene result{simulation::bodies_of(scene, part_names)};
  result.shown = viewer::shown_objects(scene, part_names);
  for (const SceneObject& object : scene.objects) {
    if (!result.part_number(object.name) && !object.motion)
      result.placed_obstacles.push_back({simulation::stopping_mesh(object), object.X_WB});
  }
  return result;
}

std::vector<std::string> movable_objects(const Scene& scene) {
  std::vector<std::string> names = scene.movable_names();
  if (!names.empty()) return names;
  throw std::invalid_argument(scene.source + ": no object is movable; a hand needs a part to hold ('movable: true')");
}

std::vector<contact::HeldPart> held_parts(const HapticScene& scene, const SlidingChoice& choice) {
  return simulation::held_parts(scene, metaphor_of(choice), stiffness_of(choice, 1.0).translational);
}

void check_names_fit_csv(const HapticScene& scene) {
  for (const std::string& name : scene.body_names) {
    if (!scene.part_number(name)) check_name_fits_csv(scene, name);  // no row names a part
  }
}

void check_name_fits_csv(const HapticScene& scene, const std::string& name) {
  if (name.find_first_of(",\"\n\r") == std::string::npos) return;
  throw std::invalid_argument(scene.source + ": object " + in_quotes(name) +
                              " has a comma, quote or line break in its name, which a CSV file cannot hold");
}

}  // namespace glissade::apps
