#include <algorithm>
#include <iterator>

#include <glissade/haptics/contact_set.h>
#include <glissade/viewer/view_simulation.h>

namespace glissade::viewer {

std::vector<ViewObject> shown_objects(const simulation::Scene& scene, const std::vector<std::string>& part_names) {
  std::vector<ViewObject> objects;
  std::size_t next = part_names.size();
  for (const simulation::SceneObject& object : scene.objects) {
    ViewObject& shown = objects.emplace_back(ViewObject{object.name, object.mesh.shared(), object.X_WB});
    const auto name = std::find(part_names.begin(), part_names.end(), object.name);
    if (name != part_names.end()) shown.part = static_cast<std::size_t>(name - part_names.begin());
    shown.moves_on_its_own = object.motion.has_value();
    if (object.motion) shown.part = next++;
  }
  return objects;
}

void show_part(const contact::SlidingResult& result, const Eigen::Vector3d& p_Vref, std::size_t part,
               contact::ContactPatches& patches, devices::HapticState& state) {
  state.parts[part] = {.X_WG = result.X_WG,
                       .X_WV = result.X_WV,
                       .p_Vref = p_Vref,
                       .state = haptics::part_state_of(result.state),
                       .contact_count = result.pushing};
  const Eigen::Isometry3d X_VW = result.X_WV_of_contacts.inverse(Eigen::Isometry);
  std::vector<contact::TrackedContact> pushing;
  for (const contact::Contact& contact : result.contacts) {
    if (!(contact.force > 0.0)) continue;
    pushing.push_back({.id = std::ssize(pushing) + 1, .contact = contact});
    if (static_cast<std::size_t>(state.contact_count) == state.contacts.size()) continue;
    state.contacts[static_cast<std::size_t>(state.contact_count++)] = {
        static_cast<std::int32_t>(part), (X_VW * contact.p_W).cast<float>(), contact.n_W.cast<float>()};
  }
  for (const contact::ContactPatch& patch : patches.merge(pushing)) {
    if (static_cast<std::size_t>(state.patch_count) == state.patches.size()) {
      ++state.patches_left_out;
      continue;
    }
    state.patches[static_cast<std::size_t>(state.patch_count++)] = {
        static_cast<std::int32_t>(part), patch.count, (X_VW * patch.p_W).cast<float>(), patch.n_W.cast<float>(),
        static_cast<float>(patch.extent)};
  }
}

}  // namespace glissade::viewer
