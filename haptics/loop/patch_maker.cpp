#include "loop/patch_maker.h"

#include <algorithm>
#include <tuple>

namespace glissade::haptics {

PatchMaker::PatchMaker(const contact::MultiPartSliding& sliding) : sliding_(sliding) {
  for (std::size_t p = 0; p < sliding.part_count(); ++p)
    patches_.emplace_back(sliding.part(p).radius());
}

bool PatchMaker::is_led_by_hand(std::size_t part) const {
  return !sliding_.is_scripted(part) && sliding_.result(part).state != contact::SlidingState::kReleased;
}

void PatchMaker::take_pushing(std::size_t part) {
  pushing_.clear();
  for (const contact::Contact& contact : sliding_.result(part).contacts) {
    if (!(contact.force > 0.0)) continue;
    const std::int32_t other = sliding_.part_of_body(contact.obstacle);
    const bool is_of_other = other >= 0 && other < static_cast<std::int32_t>(part);
    if (is_of_other && is_led_by_hand(static_cast<std::size_t>(other))) continue;
    pushing_.push_back({.id = std::ssize(pushing_) + 1, .contact = contact});
  }
}

void PatchMaker::tell(ContactSet& set) {
  set.patch_count = 0;
  set.patches_left_out = 0;
  for (std::size_t p = 0; p < sliding_.part_count(); ++p) {
    if (!is_led_by_hand(p)) continue;
    take_pushing(p);
    const std::span<const contact::ContactPatch> patches = patches_[p].merge(pushing_);
    by_force_.assign(patches.begin(), patches.end());
    std::sort(by_force_.begin(), by_force_.end(), [](const contact::ContactPatch& a, const contact::ContactPatch& b) {
      return std::tuple(-a.force_on_part_W.squaredNorm(), a.id) < std::tuple(-b.force_on_part_W.squaredNorm(), b.id);
    });
    const Eigen::Isometry3d X_VW = sliding_.result(p).X_WV_of_contacts.inverse(Eigen::Isometry);
    for (const contact::ContactPatch& patch : by_force_) {
      if (static_cast<std::size_t>(set.patch_count) == set.patches.size()) {
        ++set.patches_left_out;
        continue;
      }
      set.patches[static_cast<std::size_t>(set.patch_count++)] = {
          static_cast<std::int32_t>(p), patch.count, (X_VW * patch.p_W).cast<float>(), patch.n_W.cast<float>(),
          static_cast<float>(patch.extent)};
    }
  }
}

}  // namespace glissade::haptics
