#include <algorithm>

#include <glissade/contact/sliding_rules.h>
#include <glissade/geometry/displacement.h>

namespace glissade::contact {

std::optional<Metaphor> metaphor_from_name(std::string_view name) {
  const auto* const found = std::find(kMetaphorNames.begin(), kMetaphorNames.end(), name);
  if (found == kMetaphorNames.end()) return std::nullopt;
  return static_cast<Metaphor>(found - kMetaphorNames.begin());
}

Eigen::Isometry3d wanted_pose(Metaphor metaphor, const Eigen::Isometry3d& X_WV, const Eigen::Isometry3d& X_WG_previous,
                              const Eigen::Isometry3d& X_WG, const Eigen::Vector3d& p_Vref) {
  const MetaphorTraits& traits = traits_of(metaphor);
  if (!traits.makes_up)
    return geometry::displaced(X_WV, p_Vref, geometry::displacement_between(X_WG_previous, X_WG, p_Vref));
  if (traits.turns_part) return X_WG;
  Eigen::Isometry3d X_WT = X_WV;
  X_WT.translation() = X_WG * p_Vref - X_WV.linear() * p_Vref;
  return X_WT;
}

}  // namespace glissade::contact
