#include "pipeline/interest_matrix.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace glissade::collision {
namespace {

TEST(InterestMatrix, EnablesEveryPairAtFirstExceptAnObjectWithItself) {
  const InterestMatrix matrix;
  EXPECT_TRUE(matrix.is_enabled(0, 0, 1, 0));
  EXPECT_TRUE(matrix.is_enabled(7, 63, 3, 1));
  EXPECT_FALSE(matrix.is_enabled(7, 2, 7, 2));
}

TEST(InterestMatrix, IgnoresGroupsBothWays) {
  InterestMatrix matrix;
  matrix.disable_groups(5, 63);
  EXPECT_FALSE(matrix.is_enabled(0, 5, 1, 63));
  EXPECT_FALSE(matrix.is_enabled(0, 63, 1, 5));
  EXPECT_TRUE(matrix.is_enabled(0, 5, 1, 5));
  EXPECT_TRUE(matrix.is_enabled(0, 63, 1, 63));
  EXPECT_TRUE(matrix.is_enabled(0, 62, 1, 5));
  matrix.enable_groups(63, 5);
  EXPECT_TRUE(matrix.is_enabled(0, 5, 1, 63));
  EXPECT_TRUE(matrix.is_enabled(0, 63, 1, 5));
}

TEST(InterestMatrix, IgnoresAGroupWithinItself) {
  InterestMatrix matrix;
  matrix.disable_groups(0, 0);
  EXPECT_FALSE(matrix.is_enabled(0, 0, 1, 0));
  EXPECT_TRUE(matrix.is_enabled(0, 0, 1, 1));
}

TEST(InterestMatrix, IgnoresSinglePairsBothWays) {
  InterestMatrix matrix;
  matrix.disable_pair(9, 4);
  EXPECT_FALSE(matrix.is_enabled(9, 0, 4, 0));
  EXPECT_FALSE(matrix.is_enabled(4, 0, 9, 0));
  EXPECT_TRUE(matrix.is_enabled(9, 0, 5, 0));
  matrix.enable_pair(4, 9);
  EXPECT_TRUE(matrix.is_enabled(9, 0, 4, 0));
}

TEST(InterestMatrix, EnabledPairOfDisabledGroupsStaysDisabled) {
  InterestMatrix matrix;
  matrix.disable_groups(1, 2);
  matrix.enable_pair(0, 1);
  EXPECT_FALSE(matrix.is_enabled(0, 1, 1, 2));
}

TEST(InterestMatrix, ForgetsThePairsOfOneObjectAndNoOthers) {
  InterestMatrix matrix;
  matrix.disable_pair(1, 2);
  matrix.disable_pair(0, 1);
  matrix.disable_pair(0, 2);
  EXPECT_TRUE(matrix.forget(1));
  EXPECT_TRUE(matrix.is_enabled(1, 0, 2, 0));
  EXPECT_TRUE(matrix.is_enabled(0, 0, 1, 0));
  EXPECT_FALSE(matrix.is_enabled(0, 0, 2, 0));
  EXPECT_FALSE(matrix.forget(1));
}

TEST(InterestMatrix, RefusesGroupsThatDoNotExist) {
  InterestMatrix matrix;
  EXPECT_THROW(matrix.disable_groups(0, 64), std::invalid_argument);
  EXPECT_THROW(matrix.disable_groups(-1, 0), std::invalid_argument);
  EXPECT_THROW(matrix.enable_groups(64, 0), std::invalid_argument);
}

}  // namespace
}  // namespace glissade::collision
