// The state of a tick that viewers and recorders receive.

#include "loop/haptic_sample.h"

#include <set>

#include <gtest/gtest.h>

namespace glissade::haptics {
namespace {

using devices::PartState;
using std::chrono::milliseconds;

TEST(HapticSample, EveryStateOfTheSlidingHasItsName) {
  std::set<PartState> states;
  for (const SlidingState state : {SlidingState::kReleased, SlidingState::kFree, SlidingState::kSliding,
                                   SlidingState::kResting, SlidingState::kCatchingUp}) {
    ContactSet set;
    set.sequence = 1;
    set.parts[0].state = state;
    const devices::HapticState sample = make_sample(1, {}, set, {}, milliseconds(1));
    EXPECT_EQ(devices::name_of(sample.parts[0].state), name_of(state));
    states.insert(sample.parts[0].state);
  }
  EXPECT_EQ(states.size(), 5u);
}

TEST(HapticSample, BeforeTheSimulationHasAnsweredTheStateIsUnknown) {
  const devices::HapticState sample = make_sample(1, {}, {}, {}, milliseconds(1));
  EXPECT_EQ(sample.parts[0].state, PartState::kUnknown);
}

}  // namespace
}  // namespace glissade::haptics
