// Ghosts that a recording may name although no simulation can work on them.

#include <chrono>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include <glissade/haptics/recording.h>

#include "record/record_messages.h"

namespace glissade::haptics {
namespace {

/// An answer about a part and a hand with fingers.
AnswerRecord plain_answer() {
  AnswerRecord record;
  record.set.sequence = 1;
  record.set.hands[0].visible.activity = hands::HandActivity::kFree;
  return record;
}

bool is_readable(const std::function<void(AnswerRecord&)>& change) {
  AnswerRecord record = plain_answer();
  change(record);
  return decode_answer(encode(record)).has_value();
}

TEST(HostileRecording, GhostsThatNoSimulationCanWorkOnAreRefused) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(is_readable([](AnswerRecord&) {}));
  EXPECT_TRUE(is_readable([](AnswerRecord& record) { record.ghosts.parts[0].X_WG.translation().x() = 1e6; }));
  EXPECT_FALSE(is_readable([](AnswerRecord& record) { record.ghosts.parts[0].X_WG.translation().x() = -1.1e6; }));
  EXPECT_FALSE(is_readable([](AnswerRecord& record) { record.ghosts.parts[0].X_WG.translation().z() = kNaN; }));
  EXPECT_FALSE(is_readable([](AnswerRecord& record) { record.ghosts.parts[0].X_WG.matrix()(0, 0) = kNaN; }));
  EXPECT_FALSE(is_readable([](AnswerRecord& record) { record.ghosts.hands[0].X_WH.translation().y() = 1e300; }));
  EXPECT_FALSE(is_readable([](AnswerRecord& record) { record.ghosts.hands[0].angles[21] = kNaN; }));
  EXPECT_FALSE(is_readable([](AnswerRecord& record) { record.ghosts.time = std::chrono::nanoseconds(-1); }));
  EXPECT_FALSE(is_readable([](AnswerRecord& record) { record.ghosts.time = std::chrono::nanoseconds::max(); }));
  EXPECT_FALSE(is_readable([](AnswerRecord& record) { record.ghosts.hands[0].part = 1; })) << "there is one part";
  EXPECT_FALSE(is_readable([](AnswerRecord& record) { record.ghosts.hands[0].part = -2; }));
}

}  // namespace
}  // namespace glissade::haptics
