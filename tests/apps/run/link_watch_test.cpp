// What is told of a glove whose states do not count.

#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/apps/run/link_watch.h>

namespace glissade::apps {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// The number of calls that tell of a second glove, when between two calls the glove's messages and those of another
/// sender increase by so many.
int times_told(LinkWatch& watch, devices::LinkStatistics& link, int calls, std::uint64_t own, std::uint64_t other) {
  int told = 0;
  for (int i = 0; i < calls; ++i) {
    link.accepted += own;
    link.other_sender += other;
    told += watch.news(link).empty() ? 0 : 1;
  }
  return told;
}

TEST(SecondGlove, IsReportedOnce) {
  LinkWatch watch(1);
  devices::LinkStatistics link;
  EXPECT_EQ(times_told(watch, link, 100, 100, 0), 0);
  EXPECT_EQ(times_told(watch, link, 4, 100, 90), 0);
  EXPECT_EQ(times_told(watch, link, 100, 100, 90), 1);
  EXPECT_EQ(times_told(watch, link, 10, 100, 0) + times_told(watch, link, 100, 100, 90), 0);
}

TEST(SecondGlove, SuccessorOfASilentGloveIsNotReported) {
  LinkWatch watch(1);
  devices::LinkStatistics link;
  int told = times_told(watch, link, 20, 100, 0);
  told += times_told(watch, link, 1, 40, 60);   // the old one has just ended
  told += times_told(watch, link, 10, 0, 100);  // until its lease is over
  told += times_told(watch, link, 20, 100, 0);
  EXPECT_EQ(told, 0);
}

TEST(RefusedStates, AreReportedOncePerReason) {
  LinkWatch watch(2);
  devices::LinkStatistics link;
  link.not_finite = 3;
  EXPECT_THAT(watch.news(link), ElementsAre("states on GLOVE_STATE are refused: a number is not finite"));
  link.not_finite = 100;
  link.wrong_version = 1;
  EXPECT_THAT(watch.news(link),
              ElementsAre("states on GLOVE_STATE are refused: they have another version of the type"));
  EXPECT_THAT(watch.news(link), IsEmpty());
}

TEST(RefusedStates, NonRisingSequencesAreReportedOnlyIfFrequent) {
  LinkWatch watch(2);
  devices::LinkStatistics link;
  for (int i = 0; i < 50; ++i) {
    link.out_of_sequence += 5;  // some come twice on any network
    EXPECT_THAT(watch.news(link), IsEmpty());
  }
  link.out_of_sequence += 50;
  EXPECT_THAT(watch.news(link), ElementsAre("states of glove 2 are refused: their sequence numbers do not rise"));
}

}  // namespace
}  // namespace glissade::apps
