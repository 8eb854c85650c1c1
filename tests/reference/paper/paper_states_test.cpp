// The finite state machine of the founding paper's sliding simulation: what follows on what.

#include "paper/paper_states.h"

#include <gtest/gtest.h>

namespace glissade::reference {
namespace {

using enum PaperState;
using enum PaperEvent;

TEST(PaperStates, FreeMotionIsDone) {
  EXPECT_EQ(next_state(kMoving, kFree), kDone);
}

TEST(PaperStates, CollisionLeadsThroughTheStatesToSliding) {
  PaperState state = next_state(kMoving, kCollision);
  for (const PaperState expected : {kBisecting, kClassifying, kNewDirection, kCriterion}) {
    EXPECT_EQ(state, expected);
    state = next_state(state, state == kCriterion ? kGoOn : kWorked);
  }
  EXPECT_EQ(state, kSliding);
}

TEST(PaperStates, SlidingLeadsToMovingOrBisecting) {
  EXPECT_EQ(next_state(kSliding, kFree), kMoving);
  EXPECT_EQ(next_state(kSliding, kCollision), kBisecting);
}

TEST(PaperStates, StopOfTheCriterionIsDone) {
  EXPECT_EQ(next_state(kCriterion, kStop), kDone);
  EXPECT_EQ(next_state(kDone, kGoOn), kDone);
}

TEST(PaperStates, ImpossibleEventIsDone) {
  EXPECT_EQ(next_state(kClassifying, kCollision), kDone);
  EXPECT_EQ(next_state(kCriterion, kWorked), kDone);
}

TEST(PaperStates, HaveNames) {
  EXPECT_EQ(name_of(kMoving), "moving");
  EXPECT_EQ(name_of(kNewDirection), "new-direction");
  EXPECT_EQ(name_of(kDone), "done");
}

}  // namespace
}  // namespace glissade::reference
