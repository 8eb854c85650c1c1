// Two gloves with one number.

#include <gtest/gtest.h>

#include <glissade/apps/run/second_glove.h>

namespace glissade::apps {
namespace {

/// The number of calls that tell of a second glove, when between two calls the glove's messages and those of another
/// sender increase by so many.
int times_told(SecondGlove& watch, devices::LinkStatistics& link, int calls, std::uint64_t own, std::uint64_t other) {
  int told = 0;
  for (int i = 0; i < calls; ++i) {
    link.accepted += own;
    link.other_sender += other;
    told += watch.appears_in(link) ? 1 : 0;
  }
  return told;
}

TEST(SecondGlove, IsToldOnce) {
  SecondGlove watch;
  devices::LinkStatistics link;
  EXPECT_EQ(times_told(watch, link, 100, 100, 0), 0);
  EXPECT_EQ(times_told(watch, link, 4, 100, 90), 0);
  EXPECT_EQ(times_told(watch, link, 100, 100, 90), 1);
  EXPECT_EQ(times_told(watch, link, 10, 100, 0) + times_told(watch, link, 100, 100, 90), 0);
}

TEST(SecondGlove, IsNoGloveThatTakesThePlaceOfASilentOne) {
  SecondGlove watch;
  devices::LinkStatistics link;
  int told = times_told(watch, link, 20, 100, 0);
  told += times_told(watch, link, 1, 40, 60);   // the old one has just ended
  told += times_told(watch, link, 10, 0, 100);  // until its lease is over
  told += times_told(watch, link, 20, 100, 0);
  EXPECT_EQ(told, 0);
}

}  // namespace
}  // namespace glissade::apps
