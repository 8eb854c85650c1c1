/// What a bridge says about the tracker of the hand.

#include "hand_pose/pose_notice.h"

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace glissade::bridges {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;

/// What is said until `end` by a tracker that sends a pose every `period` except in the gap.
std::vector<std::string> said_until(milliseconds end, milliseconds period, milliseconds gap_begin,
                                    milliseconds gap_end) {
  PoseNotice notice({.device = 3, .rate_Hz = 60.0});
  std::optional<std::chrono::nanoseconds> newest;
  devices::LinkStatistics link;
  std::vector<std::string> said;
  for (milliseconds now{0}; now < end; now += milliseconds(1)) {
    const bool is_silent = now >= gap_begin && now < gap_end;
    if (!is_silent && now % period == milliseconds(0)) {
      newest = now;
      ++link.accepted;
    }
    if (const auto sentence = notice.note(newest, link, now)) said.push_back(*sentence);
  }
  return said;
}

TEST(PoseNotice, SaysThatATrackerIsMissingSilentAndBack) {
  EXPECT_THAT(said_until(milliseconds(3000), milliseconds(16), milliseconds(0), milliseconds(1000)),
              ElementsAre(HasSubstr("waiting for a tracker of hand 3"), HasSubstr("is heard")));
  EXPECT_THAT(said_until(milliseconds(9000), milliseconds(16), milliseconds(2000), milliseconds(4000)),
              ElementsAre(HasSubstr("is heard"), HasSubstr("is silent"), HasSubstr("is heard")));
}

TEST(PoseNotice, DoesNotMindAShortGap) {
  EXPECT_THAT(said_until(milliseconds(9000), milliseconds(16), milliseconds(2000), milliseconds(2300)),
              ElementsAre(HasSubstr("is heard")));
}

TEST(PoseNotice, SaysOnceThatATrackerIsTooSlow) {
  EXPECT_THAT(said_until(milliseconds(20000), milliseconds(33), milliseconds(0), milliseconds(0)),
              ElementsAre(HasSubstr("is heard"), HasSubstr("30 poses a second, fewer than the 60")));
}

TEST(PoseNotice, SaysWhyPosesAreRefused) {
  PoseNotice notice({.device = 3});
  devices::LinkStatistics link;
  link.not_finite = 1;
  link.first_not_finite = {.name = "position_WT_m", .index = 1, .value = 0.0};
  EXPECT_FALSE(notice.note({}, link, milliseconds(0)));
  const auto sentence = notice.note({}, link, milliseconds(600));
  ASSERT_TRUE(sentence);
  EXPECT_THAT(*sentence, HasSubstr("position_WT_m[1]"));
}

}  // namespace
}  // namespace glissade::bridges
