/// Kinds of grasps by their contacts.

#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/grasping/grasp_analysis.h>

#include "clasped_hand.h"

namespace glissade::grasping {
namespace {

using Eigen::Vector3d;

constexpr SegmentMeaning kPalm{Finger::kNone, HandSegment::kPalm};

SegmentMeaning inner(Finger finger) {
  return {finger, HandSegment::kInner};
}
SegmentMeaning middle(Finger finger) {
  return {finger, HandSegment::kMiddle};
}
SegmentMeaning outer(Finger finger) {
  return {finger, HandSegment::kOuter};
}

/// The contact of a segment with a body.
LinkContact touch(const SegmentMeaning& segment, const Vector3d& n_W = Vector3d::UnitX(), std::int32_t object = 0) {
  LinkContact contact{};
  for (std::size_t link = 0; link < kHandLinks; ++link) {
    const SegmentMeaning& meaning = test_support::hand_model()->meaning[link];
    if (meaning.finger == segment.finger && meaning.segment == segment.segment) contact.link = link;
  }
  contact.contact.n_W = n_W;
  contact.contact.obstacle = object;
  return contact;
}

Grasp grasp_of(const std::vector<LinkContact>& contacts) {
  GraspAnalysis analysis(*test_support::hand_model());
  constexpr double kLong_ms = 100.0;
  return analysis.update(contacts, kLong_ms);
}

TEST(GraspAnalysis, NoContactIsNoGrasp) {
  EXPECT_EQ(grasp_of({}).type, GraspType::kNone);
  EXPECT_EQ(reason_of(grasp_of({})), "none: nothing touches");
}

TEST(GraspAnalysis, OneSegmentOrThePalmAlonePushes) {
  EXPECT_EQ(grasp_of({touch(outer(Finger::kIndex))}).type, GraspType::kPush);
  EXPECT_EQ(grasp_of({touch(kPalm)}).type, GraspType::kPush);
  EXPECT_EQ(grasp_of({touch(outer(Finger::kThumb))}).type, GraspType::kPush);
  EXPECT_EQ(reason_of(grasp_of({touch(kPalm)})), "push: the palm touches");
}

TEST(GraspAnalysis, TouchingSegmentsAreEncodedAsBits) {
  const Grasp grasp = grasp_of({touch(kPalm), touch(middle(Finger::kIndex)), touch(outer(Finger::kLittle))});
  hands::VisibleHand hand;
  hand.grasp = hands::GraspType::kPower;
  hand.form = grasp.form;
  hand.touching = grasp.segments.bits();
  EXPECT_EQ(hand.touching, 1 + (1 << (4 * 2 + 2)) + (1 << (4 * 5 + 3))) << "as the message describes it";
  EXPECT_EQ(reason_of(grasping::grasp_of(hand)), reason_of(grasp));
  EXPECT_EQ(reason_of(grasping::grasp_of(hands::VisibleHand{})), "none: nothing touches");
}

TEST(GraspAnalysis, TellsWhatAGraspLacks) {
  const auto lack_of = [](const std::vector<LinkContact>& contacts) { return grasp_of(contacts).lack(); };
  const LinkContact thumb = touch(outer(Finger::kThumb));
  const LinkContact index = touch(outer(Finger::kIndex));
  EXPECT_EQ(lack_of({}), GraspLack::kTouch);
  EXPECT_EQ(lack_of({thumb, touch(middle(Finger::kThumb))}), GraspLack::kFinger);
  EXPECT_EQ(lack_of({index, touch(inner(Finger::kRing))}), GraspLack::kThumbOrPalm);
  EXPECT_EQ(lack_of({touch(kPalm), touch(inner(Finger::kIndex)), touch(inner(Finger::kThumb))}),
            GraspLack::kSegmentFartherOut);
  EXPECT_EQ(lack_of({thumb, index}), GraspLack::kNothing);
  EXPECT_EQ(lack_of({touch(kPalm), index}), GraspLack::kNothing);
  const Vector3d down = -Vector3d::UnitZ();
  EXPECT_EQ(lack_of({touch(outer(Finger::kIndex), down), touch(outer(Finger::kRing), down)}), GraspLack::kNothing)
      << "a push that carries";
}

// Whatever one lacks makes a grasp of a push, once it has come.
TEST(GraspAnalysis, WhatAGraspNeedsMakesItHold) {
  const std::map<GraspLack, std::vector<LinkContact>> needs{
      {GraspLack::kFinger, {touch(inner(Finger::kLittle))}},
      {GraspLack::kThumbOrPalm, {touch(inner(Finger::kThumb))}},
      {GraspLack::kSegmentFartherOut, {touch(middle(Finger::kLittle))}}};
  for (const SegmentMeaning& segment : TouchingSegments::meaning_of_bits()) {
    if (segment.segment == HandSegment::kNone) continue;
    std::vector<LinkContact> contacts{touch(segment)};
    const Grasp alone = grasp_of(contacts);
    ASSERT_TRUE(needs.contains(alone.lack())) << words_of(segment);
    EXPECT_FALSE(words_of(alone.lack()).empty());
    for (const LinkContact& contact : needs.at(alone.lack()))
      contacts.push_back(contact);
    EXPECT_EQ(grasp_of(contacts).lack(), GraspLack::kNothing) << words_of(segment);
  }
}

TEST(GraspAnalysis, FingersWithoutThumbAndPalmPush) {
  EXPECT_EQ(grasp_of({touch(outer(Finger::kIndex)), touch(middle(Finger::kRing))}).type, GraspType::kPush);
}

TEST(GraspAnalysis, TheThumbAloneWithSeveralSegmentsPushes) {
  EXPECT_EQ(grasp_of({touch(outer(Finger::kThumb)), touch(middle(Finger::kThumb))}).type, GraspType::kPush);
}

TEST(GraspAnalysis, ThumbAndFingerWithoutPalmAreAPrecisionGrasp) {
  const Grasp grasp = grasp_of({touch(outer(Finger::kThumb)), touch(middle(Finger::kRing))});
  EXPECT_EQ(grasp.type, GraspType::kPrecision);
  EXPECT_TRUE(grasp.holds());
}

TEST(GraspAnalysis, PalmAndAMiddleOrOuterSegmentAreAPowerGrasp) {
  const Grasp grasp = grasp_of({touch(kPalm), touch(inner(Finger::kRing)), touch(middle(Finger::kIndex))});
  EXPECT_EQ(grasp.type, GraspType::kPower);
  EXPECT_EQ(reason_of(grasp),
            "power: the palm, the middle segment of the index and the inner segment of the ring finger touch");
  EXPECT_EQ(grasp_of({touch(kPalm), touch(outer(Finger::kThumb))}).type, GraspType::kPower);
}

TEST(GraspAnalysis, PalmAndInnerSegmentsPush) {
  EXPECT_EQ(grasp_of({touch(kPalm), touch(inner(Finger::kIndex)), touch(inner(Finger::kRing))}).type, GraspType::kPush);
}

TEST(GraspAnalysis, NamesTheFormsOfPrecision) {
  const LinkContact thumb = touch(outer(Finger::kThumb), -Vector3d::UnitX());
  const LinkContact index = touch(outer(Finger::kIndex));
  EXPECT_EQ(grasp_of({thumb, index}).form, GraspForm::kTipPinch);
  EXPECT_EQ(grasp_of({thumb, index, touch(outer(Finger::kMiddle))}).form, GraspForm::kThreeJaw);
  const Vector3d beside = Vector3d(0.5, 0.87, 0.0).normalized();
  EXPECT_EQ(grasp_of({thumb, touch(outer(Finger::kIndex), beside),
                      touch(outer(Finger::kMiddle), Vector3d(beside.x(), -beside.y(), 0.0))})
                .form,
            GraspForm::kThreePoint);
  EXPECT_EQ(grasp_of({thumb, touch(middle(Finger::kIndex))}).form, GraspForm::kKey);
  EXPECT_EQ(grasp_of({thumb, index, touch(outer(Finger::kLittle))}).form, GraspForm::kNone);
}

TEST(GraspAnalysis, TwoNeighboringFingersFromOppositeSidesHoldACigarette) {
  const LinkContact index = touch(middle(Finger::kIndex), Vector3d::UnitY());
  const LinkContact middle_finger = touch(middle(Finger::kMiddle), -Vector3d::UnitY());
  const Grasp grasp = grasp_of({index, middle_finger});
  EXPECT_EQ(grasp.type, GraspType::kPush) << "by the paper's rules";
  EXPECT_EQ(grasp.form, GraspForm::kCigarette);
  EXPECT_TRUE(grasp.holds());
  EXPECT_EQ(grasp_of({index, touch(middle(Finger::kMiddle), Vector3d::UnitY())}).form, GraspForm::kNone);
  EXPECT_EQ(grasp_of({index, touch(middle(Finger::kRing), -Vector3d::UnitY())}).form, GraspForm::kNone);
}

TEST(GraspAnalysis, SegmentsBelowAnObjectCarryIt) {
  const Vector3d down = -Vector3d::UnitZ();
  EXPECT_EQ(grasp_of({touch(kPalm, down), touch(inner(Finger::kMiddle), down)}).form, GraspForm::kGravity);
  EXPECT_EQ(grasp_of({touch(kPalm, down)}).form, GraspForm::kNone) << "one contact does not carry";
  EXPECT_EQ(grasp_of({touch(kPalm, down), touch(middle(Finger::kMiddle), -down)}).form, GraspForm::kNone);
  EXPECT_EQ(grasp_of({touch(outer(Finger::kIndex), down), touch(outer(Finger::kRing), down)}).form,
            GraspForm::kGravity);
  EXPECT_EQ(grasp_of({touch(outer(Finger::kThumb), down), touch(middle(Finger::kThumb), down)}).form, GraspForm::kNone)
      << "one finger does not carry";
}

TEST(GraspAnalysis, SegmentsOnDifferentBodiesMakeNoGrasp) {
  const Grasp grasp =
      grasp_of({touch(outer(Finger::kThumb), Vector3d::UnitX(), 0), touch(outer(Finger::kIndex), Vector3d::UnitX(), 1),
                touch(outer(Finger::kMiddle), Vector3d::UnitX(), 1)});
  EXPECT_EQ(grasp.type, GraspType::kPush);
  EXPECT_EQ(grasp.object, 1) << "most segments touch it";
}

TEST(GraspAnalysis, AFingertipOnTheTableGraspsAPartThatItTouchesToo) {
  constexpr std::int32_t kTable = 0;
  constexpr std::int32_t kPart = 1;
  GraspAnalysis analysis(*test_support::hand_model(), 1);
  const LinkContact index_on_table = touch(outer(Finger::kIndex), Vector3d::UnitZ(), kTable);
  std::vector<LinkContact> contacts{touch(outer(Finger::kThumb), -Vector3d::UnitX(), kTable), index_on_table};
  for (int ms = 0; ms < 100; ++ms)
    EXPECT_NE(analysis.update(contacts, 1.0).object, kPart);
  contacts = {index_on_table, touch(outer(Finger::kThumb), -Vector3d::UnitX(), kPart),
              touch(outer(Finger::kIndex), Vector3d::UnitX(), kPart), index_on_table};
  for (int ms = 0; ms < 25; ++ms)
    analysis.update(contacts, 1.0);
  EXPECT_EQ(analysis.grasp().form, GraspForm::kTipPinch) << "while the thumb counts as touching the table still";
  EXPECT_EQ(analysis.grasp().object, kPart) << reason_of(analysis.grasp());
  for (const LinkContact& contact : contacts)
    analysis.forget(contact.link, kPart);
  contacts = {index_on_table};
  EXPECT_EQ(analysis.update(contacts, 1.0).object, kTable) << "what left the part may be at the table still";
}

TEST(GraspAnalysis, GraspOfAPartPrecedesAFirmerGraspOfAFixedObject) {
  std::vector<LinkContact> contacts{
      touch(kPalm, Vector3d::UnitX(), 0), touch(middle(Finger::kRing), Vector3d::UnitX(), 0),
      touch(outer(Finger::kThumb), -Vector3d::UnitX(), 1), touch(outer(Finger::kIndex), Vector3d::UnitX(), 1)};
  constexpr double kLong_ms = 100.0;
  EXPECT_EQ(GraspAnalysis(*test_support::hand_model(), 1).update(contacts, kLong_ms).object, 1);
  EXPECT_EQ(GraspAnalysis(*test_support::hand_model(), 2).update(contacts, kLong_ms).object, 0) << "both are fixed";
  EXPECT_EQ(GraspAnalysis(*test_support::hand_model()).update(contacts, kLong_ms).object, 0) << "both may move";
  contacts.pop_back();
  EXPECT_EQ(GraspAnalysis(*test_support::hand_model(), 1).update(contacts, kLong_ms).object, 0)
      << "a push holds nothing";
}

TEST(GraspAnalysis, ASegmentTouchesThreeBodiesAtOnceAndAFourthAfterOneOfThem) {
  GraspAnalysis analysis(*test_support::hand_model());
  std::vector<LinkContact> contacts;
  for (const std::int32_t body : {0, 1, 2, 3})
    contacts.push_back(touch(outer(Finger::kIndex), Vector3d::UnitX(), body));
  const LinkContact thumb = touch(outer(Finger::kThumb), -Vector3d::UnitX(), 3);
  contacts.push_back(thumb);
  constexpr double kLong_ms = 100.0;
  EXPECT_EQ(analysis.update(contacts, kLong_ms).type, GraspType::kPush);
  contacts.erase(contacts.begin());
  analysis.update(contacts, kLong_ms);
  EXPECT_EQ(analysis.update(contacts, kLong_ms).type, GraspType::kPrecision);
  EXPECT_EQ(analysis.grasp().object, 3);
}

TEST(GraspAnalysis, AContactThatIsMissingForAMomentMakesNoGraspFlicker) {
  GraspAnalysis analysis(*test_support::hand_model());
  const std::vector<LinkContact> whole{touch(outer(Finger::kThumb)), touch(outer(Finger::kIndex))};
  const std::vector<LinkContact> without_thumb{whole[1]};
  for (int i = 0; i < 100; ++i)
    analysis.update(whole, 1.0);
  for (int i = 0; i < 50; ++i)
    EXPECT_EQ(analysis.update(without_thumb, 1.0).type, GraspType::kPrecision) << i;
  for (int i = 0; i < 50; ++i)
    analysis.update(without_thumb, 1.0);
  EXPECT_EQ(analysis.grasp().type, GraspType::kPush) << "it is over";
  analysis.clear();
  EXPECT_EQ(analysis.update({}, 1.0).type, GraspType::kNone);
}

TEST(GraspAnalysis, AContactThatComesNowAndThenChangesNoGrasp) {
  GraspAnalysis analysis(*test_support::hand_model());
  const std::vector<LinkContact> pinch{touch(outer(Finger::kThumb)), touch(outer(Finger::kIndex))};
  std::vector<LinkContact> grazed = pinch;
  grazed.push_back(touch(middle(Finger::kIndex)));
  for (int i = 0; i < 100; ++i)
    analysis.update(pinch, 1.0);
  for (int i = 0; i < 1000; ++i)
    ASSERT_EQ(analysis.update(i % 4 == 0 ? grazed : pinch, 1.0).form, GraspForm::kTipPinch) << i;
}

TEST(GraspAnalysis, ANewContactCountsAfterSomeMilliseconds) {
  GraspAnalysis analysis(*test_support::hand_model());
  const std::vector<LinkContact> contacts{touch(outer(Finger::kIndex))};
  int delay_ms = 1;
  while (analysis.update(contacts, 1.0).type == GraspType::kNone && delay_ms < 100)
    ++delay_ms;
  EXPECT_GT(delay_ms, 5);
  EXPECT_LE(delay_ms, 25);
}

}  // namespace
}  // namespace glissade::grasping
