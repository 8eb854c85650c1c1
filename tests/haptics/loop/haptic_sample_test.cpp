// The state of a tick that viewers and recorders receive.

#include "loop/haptic_sample.h"

#include <numbers>
#include <set>
#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace glissade::haptics {
namespace {

using devices::PartState;
using std::chrono::microseconds;
using std::chrono::milliseconds;

/// The sample of a tick without hands.
devices::HapticState sample_of(const ContactSet& set) {
  TickRecord record;
  record.sequence = 1;
  record.time = milliseconds(1);
  return make_sample(record, set, {});
}

TEST(HapticSample, EveryStateOfTheSlidingHasItsName) {
  std::set<PartState> states;
  for (const contact::SlidingState state :
       {contact::SlidingState::kReleased, contact::SlidingState::kFree, contact::SlidingState::kSliding,
        contact::SlidingState::kResting, contact::SlidingState::kCatchingUp}) {
    ContactSet set;
    set.sequence = 1;
    set.parts[0].state = state;
    const devices::HapticState sample = sample_of(set);
    EXPECT_EQ(devices::name_of(sample.parts[0].state), name_of(state));
    states.insert(sample.parts[0].state);
  }
  EXPECT_EQ(states.size(), 5u);
}

TEST(HapticSample, BeforeTheSimulationHasAnsweredTheStateIsUnknown) {
  const devices::HapticState sample = sample_of({});
  EXPECT_EQ(sample.parts[0].state, PartState::kUnknown);
}

TEST(HapticSample, TellsHowLateTheTickWasAndHowLongTheOneBefore) {
  TickRecord record;
  record.sequence = 2;
  record.deadline = milliseconds(5);
  record.time = milliseconds(5) + microseconds(30);
  record.last_duration = microseconds(4);
  const devices::HapticState sample = make_sample(record, {}, {});
  EXPECT_EQ(sample.lateness, microseconds(30));
  EXPECT_EQ(sample.last_duration, microseconds(4));
}

TEST(HapticSample, ContactsThatPushStandInTheFrameOfTheirPart) {
  ContactSet set;
  set.part_count = 2;
  set.parts[1].p_Vref = Eigen::Vector3d(0.0, 0.0, 0.5);
  set.parts[1].X_WV_of_rows =
      Eigen::Translation3d(7.0, 8.0, 9.0) * Eigen::AngleAxisd(std::numbers::pi / 2.0, Eigen::Vector3d::UnitZ());
  set.row_count = 2;
  set.row_array[0].part = 0;  // does not push
  ContactRow& row = set.row_array[1];
  row.part = 1;
  row.pushes = true;
  row.n = Eigen::Vector3d::UnitX();
  row.r = Eigen::Vector3d(0.0, 0.25, 0.0);  // the quarter turn makes it x in V
  const devices::HapticState sample = sample_of(set);
  ASSERT_EQ(sample.contact_count, 1);
  EXPECT_EQ(sample.contacts[0].part, 1);
  EXPECT_TRUE(sample.contacts[0].p_V.isApprox(Eigen::Vector3f(0.25F, 0.0F, 0.5F), 1e-6F));
  EXPECT_TRUE(sample.contacts[0].n_W.isApprox(Eigen::Vector3f::UnitX()));
}

TEST(HapticSample, ContactsBeyondCapacityAreOmitted) {
  ContactSet set;
  set.row_count = static_cast<std::int32_t>(devices::kHapticContacts) + 5;
  for (ContactRow& row : set.row_array)
    row.pushes = true;
  EXPECT_EQ(static_cast<std::size_t>(sample_of(set).contact_count), devices::kHapticContacts);
}

TEST(HapticSample, HasThePatchesOfTheSet) {
  ContactSet set;
  set.patch_count = 2;
  set.patches_left_out = 1;
  set.patches[1] = {3, 5, Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitZ(), 0.5F};
  set.patches[2] = set.patches[1];
  const devices::HapticState sample = sample_of(set);
  EXPECT_EQ(sample.patch_count, 2);
  EXPECT_EQ(sample.patches_left_out, 1);
  EXPECT_EQ(sample.patches[1].part, 3);
  EXPECT_EQ(sample.patches[1].extent, 0.5F);
  EXPECT_EQ(sample.patches[2].extent, 0.0F) << "left behind by an older set";
}

}  // namespace
}  // namespace glissade::haptics
