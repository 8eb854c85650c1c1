/// Why a hand has held nothing.

#include <vector>

#include <gtest/gtest.h>

#include <glissade/apps/run/missed_grasp.h>

namespace glissade::apps {
namespace {

using grasping::Finger;
using grasping::Grasp;
using grasping::GraspType;
using grasping::HandSegment;
using grasping::SegmentMeaning;

constexpr std::int32_t kTable = 0;
constexpr std::int32_t kMug = 1;
constexpr SegmentMeaning kPalm{Finger::kNone, HandSegment::kPalm};

SegmentMeaning outer(Finger finger) {
  return {finger, HandSegment::kOuter};
}

Grasp push_of(std::int32_t object, const std::vector<SegmentMeaning>& segments) {
  Grasp grasp{.type = GraspType::kPush, .object = object};
  for (const SegmentMeaning& segment : segments)
    grasp.segments.add(segment);
  return grasp;
}

MissedGrasp on_table() {
  return MissedGrasp({"table", "mug"}, {false, true});
}

/// The same touch from one time to another, at each hundredth of a second.
void touch(MissedGrasp& missed, double first_s, double last_s, const Grasp& grasp, bool holds = false) {
  for (int i = 0; first_s + 0.01 * i < last_s + 0.001; ++i)
    missed.note(first_s + 0.01 * i, grasp, holds);
}

TEST(MissedGrasp, TellsWhoPushedWhatAndWhatAGraspNeeds) {
  MissedGrasp missed = on_table();
  touch(missed, 0.0, 0.39, {});
  touch(missed, 0.4, 1.28, push_of(kMug, {outer(Finger::kThumb)}));
  touch(missed, 1.3, 2.0, {});
  EXPECT_EQ(missed.text(),
            "the thumb alone pushed 'mug' from 0.400 to 1.280 s: a grasp needs a finger as well, or the palm and a "
            "middle or outer segment");
}

TEST(MissedGrasp, NamesAllFingersThatPushedMeanwhile) {
  MissedGrasp missed = on_table();
  touch(missed, 0.0, 0.1, push_of(kMug, {outer(Finger::kIndex)}));
  touch(missed, 0.11, 0.3, push_of(kMug, {outer(Finger::kIndex), outer(Finger::kMiddle), outer(Finger::kLittle)}));
  EXPECT_TRUE(missed.text().starts_with(
      "the index, the middle finger and the little finger alone pushed 'mug' from 0.000 to 0.300 s: "))
      << missed.text();
  MissedGrasp of_palm = on_table();
  touch(of_palm, 0.0, 0.1, push_of(kMug, {kPalm, {Finger::kIndex, HandSegment::kInner}}));
  EXPECT_TRUE(of_palm.text().starts_with("the palm and inner segments alone pushed 'mug'")) << of_palm.text();
}

TEST(MissedGrasp, PrefersTheLongestTouchOfWhatHandsCanHold) {
  MissedGrasp missed = on_table();
  touch(missed, 0.0, 0.3, push_of(kMug, {outer(Finger::kThumb)}));
  touch(missed, 0.4, 0.8, push_of(kMug, {outer(Finger::kIndex)}));
  touch(missed, 0.9, 3.0, push_of(kTable, {outer(Finger::kIndex)}));
  EXPECT_TRUE(missed.text().starts_with("the index alone pushed 'mug' from 0.400 to 0.800 s: ")) << missed.text();
}

TEST(MissedGrasp, SaysIfNothingOrOnlyAFixedObjectWasTouched) {
  EXPECT_EQ(MissedGrasp().text(), "it touched nothing for more than a moment");
  MissedGrasp of_table = on_table();
  touch(of_table, 0.5, 0.7, push_of(kTable, {kPalm}));
  EXPECT_EQ(of_table.text(), "it touched 'table' from 0.500 to 0.700 s, which no hand can hold");
}

TEST(MissedGrasp, TextIsEmptyIfTheHandHasHeld) {
  MissedGrasp missed = on_table();
  touch(missed, 0.0, 0.3, push_of(kMug, {outer(Finger::kThumb)}));
  touch(missed, 0.3, 0.4, push_of(kMug, {outer(Finger::kThumb), outer(Finger::kIndex)}), true);
  touch(missed, 0.5, 3.0, push_of(kMug, {outer(Finger::kThumb)}));
  EXPECT_EQ(missed.text(), "");
}

// The haptic loop does not tell what a hand touches.
TEST(MissedGrasp, UnknownObjectIsCalledSomething) {
  MissedGrasp missed;
  touch(missed, 0.0, 0.2, push_of(-1, {outer(Finger::kThumb)}));
  EXPECT_TRUE(missed.text().starts_with("the thumb alone touched something from 0.000 to 0.200 s: a grasp needs a "))
      << missed.text();
  Grasp firm = push_of(-1, {outer(Finger::kThumb), outer(Finger::kIndex)});
  firm.type = GraspType::kPrecision;
  MissedGrasp of_lever;
  touch(of_lever, 0.0, 0.2, firm);
  EXPECT_EQ(of_lever.text(), "it touched something from 0.000 to 0.200 s, which no hand can hold");
}

}  // namespace
}  // namespace glissade::apps
