#include "life/finger_rows.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

namespace glissade::grasping {
namespace {

haptics::FingerRow row_of(const KinematicChain& chain, const LinkContact& touch,
                          std::span<const Eigen::Isometry3d> X_WL, std::int32_t first_part) {
  haptics::FingerRow row;
  row.part = std::max(-1, touch.contact.obstacle - first_part);
  row.n_W = touch.contact.n_W;
  row.p_W = touch.contact.p_W;
  row.gap = std::max(0.0, touch.contact.gap - touch.contact.margin);
  const std::span<const ChainLink> links = chain.links();
  for (std::optional<std::size_t> l = touch.link; l; l = links[*l].parent) {
    if (links[*l].terms.empty()) continue;
    const Eigen::Vector3d axis_W = X_WL[*l].linear() * links[*l].axis_J;
    const double per_rad = touch.contact.n_W.dot(axis_W.cross(touch.contact.p_W - X_WL[*l].translation()));
    for (const JointTerm& term : links[*l].terms)
      row.rates[term.value] += term.factor * per_rad;
  }
  return row;
}

}  // namespace

void tell_visible(const KinematicChain& chain, const Posture& visible, std::span<const LinkContact> contacts,
                  std::int32_t first_part, std::vector<Eigen::Isometry3d>& X_WL, haptics::HandAnswer& answer) {
  answer.visible.X_WH = visible.X_WR;
  std::copy(visible.values.begin(), visible.values.end(), answer.visible.angles.begin());
  std::array<LinkContact, haptics::kMaxFingerRows> deepest;
  const auto end = std::partial_sort_copy(contacts.begin(), contacts.end(), deepest.begin(), deepest.end(),
                                          [](const LinkContact& a, const LinkContact& b) { return a.depth > b.depth; });
  X_WL.resize(chain.links().size());
  chain.poses(visible.X_WR, visible.values, X_WL);
  answer.row_count = static_cast<std::int32_t>(end - deepest.begin());
  for (std::size_t i = 0; i < static_cast<std::size_t>(answer.row_count); ++i)
    answer.row_array[i] = row_of(chain, deepest[i], X_WL, first_part);
}

}  // namespace glissade::grasping
