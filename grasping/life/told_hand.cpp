#include "life/told_hand.h"

namespace glissade::grasping {
namespace {

devices::GraspKind kind_of(GraspType type) {
  const auto has_number = [](GraspType a, devices::GraspKind b) { return static_cast<int>(a) == static_cast<int>(b); };
  static_assert(has_number(GraspType::kNone, devices::GraspKind::kNone) &&
                has_number(GraspType::kPush, devices::GraspKind::kPush) &&
                has_number(GraspType::kPrecision, devices::GraspKind::kPrecision) &&
                has_number(GraspType::kPower, devices::GraspKind::kPower));
  return static_cast<devices::GraspKind>(type);
}

}  // namespace

devices::HandActivity activity_of(const GraspingHand& hand) {
  if (hand.part()) return devices::HandActivity::kHolding;
  if (hand.is_lost()) return devices::HandActivity::kLost;
  return hand.is_present() ? devices::HandActivity::kFree : devices::HandActivity::kWaiting;
}

void tell_grasp(const GraspingHand& hand, devices::VisibleHand& told) {
  told.activity = activity_of(hand);
  told.grasp = kind_of(hand.grasp().type);
  told.form = hand.grasp().form;
  told.touching = hand.grasp().segments.bits();
}

}  // namespace glissade::grasping
