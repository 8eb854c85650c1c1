#include "life/finger_rows.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

#include <glissade/devices/glove_device.h>
#include <glissade/haptics/finger_forces.h>

namespace glissade::grasping {
namespace {

haptics::FingerRow row_of(const KinematicChain& chain, const LinkContact& touch,
                          std::span<const Eigen::Isometry3d> X_WL, std::int32_t first_part) {
  haptics::FingerRow row;
  row.part = std::max(-1, touch.contact.obstacle - first_part);
  row.n_W = touch.contact.n_W;
  row.p_W = touch.contact.p_W;
  row.gap = std::max(0.0, touch.contact.gap - touch.contact.margin);
  chain.add_rates(touch.link, row.p_W, row.n_W, X_WL, row.rates);
  return row;
}

}  // namespace

void FingerRows::tell(const Clasp& clasp, std::span<const LinkContact> contacts, std::int32_t first_part,
                      haptics::HandAnswer& answer) {
  const KinematicChain& chain = clasp.chain();
  const Posture& visible = clasp.posture();
  answer.visible.X_WH = visible.X_WR;
  std::copy(visible.values.begin(), visible.values.end(), answer.visible.angles.begin());
  X_WL_.resize(chain.links().size());
  chain.poses(visible.X_WR, visible.values, X_WL_);
  rows_.clear();
  for (const LinkContact& touch : contacts)
    rows_.push_back(row_of(chain, touch, X_WL_, first_part));
  choose(clasp, contacts);
  answer.row_count = static_cast<std::int32_t>(chosen_.size());
  for (std::size_t i = 0; i < chosen_.size(); ++i)
    answer.row_array[i] = rows_[chosen_[i]];
}

void FingerRows::choose(const Clasp& clasp, std::span<const LinkContact> contacts) {
  by_depth_.resize(contacts.size());
  std::iota(by_depth_.begin(), by_depth_.end(), std::size_t{0});
  std::stable_sort(by_depth_.begin(), by_depth_.end(),
                   [&](std::size_t a, std::size_t b) { return contacts[a].depth > contacts[b].depth; });
  priorities_.assign(contacts.size(), Priority::kOther);
  if (contacts.size() > haptics::kMaxFingerRows) {
    choose_strongest(clasp);
    choose_of_each_segment(contacts);
  }
  chosen_.clear();
  for (const Priority priority : {Priority::kStrongest, Priority::kOfSegment, Priority::kOther}) {
    for (const std::size_t i : by_depth_) {
      if (priorities_[i] == priority && chosen_.size() < haptics::kMaxFingerRows) chosen_.push_back(i);
    }
  }
}

/// For each joint the contact that pushes it back the farthest.
void FingerRows::choose_strongest(const Clasp& clasp) {
  devices::JointValues lags{};
  for (std::size_t v = 0; v < clasp.posture().values.size(); ++v)
    lags[v] = clasp.target().values[v] - clasp.posture().values[v];
  devices::JointValues deepest{};
  std::array<std::size_t, devices::kGloveJoints> strongest{};
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    devices::JointValues depths = deepest;
    haptics::deepen(rows_[i], lags, depths);
    for (std::size_t v = 0; v < depths.size(); ++v) {
      if (depths[v] > deepest[v]) strongest[v] = i;
    }
    deepest = depths;
  }
  for (std::size_t v = 0; v < deepest.size(); ++v) {
    if (deepest[v] > 0.0) priorities_[strongest[v]] = Priority::kStrongest;
  }
}

/// The deepest contact of each segment with each object that has none yet.
void FingerRows::choose_of_each_segment(std::span<const LinkContact> contacts) {
  const auto is_same = [&](std::size_t a, std::size_t b) {
    return contacts[a].link == contacts[b].link && contacts[a].contact.obstacle == contacts[b].contact.obstacle;
  };
  for (const std::size_t i : by_depth_) {
    const bool has_one = std::any_of(by_depth_.begin(), by_depth_.end(), [&](std::size_t other) {
      return priorities_[other] != Priority::kOther && is_same(i, other);
    });
    if (!has_one) priorities_[i] = Priority::kOfSegment;
  }
}

}  // namespace glissade::grasping
