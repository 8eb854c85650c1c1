#include <gtest/gtest.h>

#include <glissade/collision/dop.h>

namespace glissade::collision {
namespace {

TEST(Dop, HalfSpacesComeInOppositePairs) {
  for (int i = 0; i < kDopDirections; ++i) {
    EXPECT_EQ(dop_direction(opposite(i)), -dop_direction(i));
    EXPECT_EQ(opposite(opposite(i)), i);
  }
}

}  // namespace
}  // namespace glissade::collision
