#include "record/answers_ahead.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace glissade::haptics {
namespace {

Ghosts ghosts_at(std::int64_t milliseconds) {
  Ghosts ghosts;
  ghosts.time = std::chrono::milliseconds(milliseconds);
  return ghosts;
}

TEST(AnswersAhead, ComeInTheOrderOfTheQuestions) {
  AnswersAhead ahead([](const Ghosts& ghosts, ContactSet& set) { set.time = ghosts.time; });
  for (int i = 1; i <= 5; ++i)
    ahead.ask(ghosts_at(i));
  for (int i = 1; i <= 5; ++i)
    EXPECT_EQ(ahead.take()->set.time, std::chrono::milliseconds(i));
  EXPECT_EQ(ahead.outstanding(), 0U);
}

TEST(AnswersAhead, PassFailuresOfTheSimulationOn) {
  int left = 2;
  AnswersAhead ahead([&left](const Ghosts&, ContactSet&) {
    if (--left < 0) throw std::runtime_error("no more");
  });
  for (int i = 1; i <= 4; ++i)
    ahead.ask(ghosts_at(i));
  ahead.take();
  ahead.take();
  EXPECT_THROW(ahead.take(), std::runtime_error);
}

}  // namespace
}  // namespace glissade::haptics
