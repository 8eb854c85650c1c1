#include "loop/finger_rows.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

#include <glissade/haptics/finger_forces.h>

namespace glissade::haptics {
namespace {

FingerRow row_of(const grasping::KinematicChain& chain, const grasping::LinkContact& touch,
                 std::span<const Eigen::Isometry3d> X_WL, std::int32_t first_part) {
  FingerRow row;
  row.part = std::max(-1, touch.contact.obstacle - first_part);
  row.n_W = touch.contact.n_W;
  row.p_W = touch.contact.p_W;
  row.gap = std::max(0.0, touch.contact.gap - touch.contact.margin);
  chain.add_rates(touch.link, row.p_W, row.n_W, X_WL, row.rates);
  return row;
}

}  // namespace

void FingerRows::tell(const grasping::GraspSimulation& simulation, std::size_t hand, HandAnswer& answer) {
  const grasping::HoldDecision& decision = simulation.decision(hand);
  answer.visible = simulation.visible(hand);
  answer.part = decision.part ? static_cast<std::int32_t>(*decision.part) : -1;
  answer.decision = decision.number;
  tell(simulation.clasp(hand), simulation.contacts(hand),
       static_cast<std::int32_t>(simulation.parts().obstacle_count()), answer);
}

void FingerRows::tell(const grasping::Clasp& clasp, std::span<const grasping::LinkContact> contacts,
                      std::int32_t first_part, HandAnswer& answer) {
  const grasping::KinematicChain& chain = clasp.chain();
  const grasping::Posture& visible = clasp.posture();
  answer.visible.X_WH = visible.X_WR;
  std::copy(visible.values.begin(), visible.values.end(), answer.visible.angles.begin());
  X_WL_.resize(chain.links().size());
  chain.poses(visible.X_WR, visible.values, X_WL_);
  rows_.clear();
  for (const grasping::LinkContact& touch : contacts)
    rows_.push_back(row_of(chain, touch, X_WL_, first_part));
  choose(clasp, contacts);
  answer.row_count = static_cast<std::int32_t>(chosen_.size());
  for (std::size_t i = 0; i < chosen_.size(); ++i)
    answer.row_array[i] = rows_[chosen_[i]];
}

void FingerRows::choose(const grasping::Clasp& clasp, std::span<const grasping::LinkContact> contacts) {
  by_depth_.resize(contacts.size());
  std::iota(by_depth_.begin(), by_depth_.end(), std::size_t{0});
  std::stable_sort(by_depth_.begin(), by_depth_.end(),
                   [&](std::size_t a, std::size_t b) { return contacts[a].depth > contacts[b].depth; });
  priorities_.assign(contacts.size(), Priority::kOther);
  if (contacts.size() > kMaxFingerRows) {
    choose_strongest(clasp);
    choose_of_each_segment(contacts);
  }
  chosen_.clear();
  for (const Priority priority : {Priority::kStrongest, Priority::kOfSegment, Priority::kOther}) {
    for (const std::size_t i : by_depth_) {
      if (priorities_[i] == priority && chosen_.size() < kMaxFingerRows) chosen_.push_back(i);
    }
  }
}

/// For each joint the contact that pushes it back the farthest.
void FingerRows::choose_strongest(const grasping::Clasp& clasp) {
  hands::JointValues lags{};
  for (std::size_t v = 0; v < clasp.posture().values.size(); ++v)
    lags[v] = clasp.target().values[v] - clasp.posture().values[v];
  hands::JointValues deepest{};
  std::array<std::size_t, hands::kJoints> strongest{};
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    hands::JointValues depths = deepest;
    deepen(rows_[i], lags, depths);
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
void FingerRows::choose_of_each_segment(std::span<const grasping::LinkContact> contacts) {
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

}  // namespace glissade::haptics
