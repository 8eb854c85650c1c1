#include <stdexcept>

#include <gtest/gtest.h>

#include <glissade/collision/interest_matrix.h>

namespace glissade::collision {
namespace {

TEST(InterestMatrix, AttendsToEveryPairAtFirstButToNoObjectAndItself) {
  const InterestMatrix matrix;
  EXPECT_TRUE(matrix.attends(0, 0, 1, 0));
  EXPECT_TRUE(matrix.attends(7, 63, 3, 1));
  EXPECT_FALSE(matrix.attends(7, 2, 7, 2));
}

TEST(InterestMatrix, IgnoresGroupsBothWays) {
  InterestMatrix matrix;
  matrix.ignore_groups(5, 63);
  EXPECT_FALSE(matrix.attends(0, 5, 1, 63));
  EXPECT_FALSE(matrix.attends(0, 63, 1, 5));
  EXPECT_TRUE(matrix.attends(0, 5, 1, 5));
  EXPECT_TRUE(matrix.attends(0, 63, 1, 63));
  EXPECT_TRUE(matrix.attends(0, 62, 1, 5));
  matrix.attend_groups(63, 5);
  EXPECT_TRUE(matrix.attends(0, 5, 1, 63));
  EXPECT_TRUE(matrix.attends(0, 63, 1, 5));
}

TEST(InterestMatrix, IgnoresAGroupWithinItself) {
  InterestMatrix matrix;
  matrix.ignore_groups(0, 0);
  EXPECT_FALSE(matrix.attends(0, 0, 1, 0));
  EXPECT_TRUE(matrix.attends(0, 0, 1, 1));
}

TEST(InterestMatrix, IgnoresSinglePairsBothWays) {
  InterestMatrix matrix;
  matrix.ignore(9, 4);
  EXPECT_FALSE(matrix.attends(9, 0, 4, 0));
  EXPECT_FALSE(matrix.attends(4, 0, 9, 0));
  EXPECT_TRUE(matrix.attends(9, 0, 5, 0));
  matrix.attend(4, 9);
  EXPECT_TRUE(matrix.attends(9, 0, 4, 0));
}

TEST(InterestMatrix, APairIsAttendedToOnlyIfItsGroupsAre) {
  InterestMatrix matrix;
  matrix.ignore_groups(1, 2);
  matrix.attend(0, 1);
  EXPECT_FALSE(matrix.attends(0, 1, 1, 2));
}

TEST(InterestMatrix, ForgetsThePairsOfOneObjectAndNoOthers) {
  InterestMatrix matrix;
  matrix.ignore(1, 2);
  matrix.ignore(0, 1);
  matrix.ignore(0, 2);
  EXPECT_TRUE(matrix.forget(1));
  EXPECT_TRUE(matrix.attends(1, 0, 2, 0));
  EXPECT_TRUE(matrix.attends(0, 0, 1, 0));
  EXPECT_FALSE(matrix.attends(0, 0, 2, 0));
  EXPECT_FALSE(matrix.forget(1));
}

TEST(InterestMatrix, RefusesGroupsThatDoNotExist) {
  InterestMatrix matrix;
  EXPECT_THROW(matrix.ignore_groups(0, 64), std::invalid_argument);
  EXPECT_THROW(matrix.ignore_groups(-1, 0), std::invalid_argument);
  EXPECT_THROW(matrix.attend_groups(64, 0), std::invalid_argument);
}

}  // namespace
}  // namespace glissade::collision
