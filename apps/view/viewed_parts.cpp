#include <algorithm>
#include <cstddef>

#include <Eigen/Geometry>

#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/apps/text.h>
#include <glissade/apps/view/viewed_parts.h>

namespace glissade::apps {
namespace {

Eigen::Vector3d compliance_point(const SceneObject& object) {
  return object.compliance_point_B.value_or(geometry::bounds_of(*object.mesh).center());
}

bool has_fingers(const devices::HapticState& state) {
  return std::any_of(state.hands.begin(), state.hands.begin() + state.hand_count,
                     [](const auto& hand) { return hand.visible.activity != hands::HandActivity::kNone; });
}

}  // namespace

ViewedParts::ViewedParts(const Scene& scene) : source_(scene.source) {
  for (const std::string& name : movable_objects(scene))
    parts_.push_back({name, compliance_point(scene.find(name))});
  for (const SceneObject& object : scene.objects) {
    if (object.motion) parts_.push_back({object.name, compliance_point(object)});
  }
}

std::string ViewedParts::doubt(const devices::HapticState& state) const {
  constexpr double kSame_m = 1e-5;
  const auto count = static_cast<std::size_t>(state.part_count);
  if (count != parts_.size()) {
    return "the server moves " + std::to_string(count) + " parts, " + source_ + " has " +
           std::to_string(parts_.size()) + ": is it the server's scene?";
  }
  if (has_fingers(state)) return "";
  for (std::size_t p = 0; p < count; ++p) {
    const devices::HapticPartState& part = state.parts[p];
    if (part.state == devices::PartState::kUnknown) continue;  // nothing has been simulated yet
    if ((part.p_Vref - parts_[p].p_Vref).norm() <= kSame_m) continue;
    return "the server's part " + std::to_string(p) + " is another one than " + in_quotes(parts_[p].name) + " of " +
           source_ + ": is it the server's scene?";
  }
  return "";
}

}  // namespace glissade::apps
