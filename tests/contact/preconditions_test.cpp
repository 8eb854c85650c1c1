// What callers must not do: set-up code throws a sentence, everything else ends the program where assertions are on.

#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/contact/contact_body.h>
#include <glissade/contact/sliding.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/reference/sliding_method.h>

#include "assertions.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::shared_ptr<const geometry::TriangleMesh> box_mesh() {
  return std::make_shared<geometry::TriangleMesh>(geometry::make_box({0.1, 0.1, 0.1}, 12));
}

Isometry3d above() {
  return Isometry3d(Eigen::Translation3d(0.0, 0.0, 0.2));
}

class ContactPreconditions : public ::testing::Test {
 protected:
  const Obstacle block_{.body = std::make_shared<ContactBody>(box_mesh()), .name = "the block"};
  const std::shared_ptr<const SlidingPart> part_ = std::make_shared<SlidingPart>(box_mesh());
};

TEST_F(ContactPreconditions, ABodyNeedsAMesh) {
  EXPECT_THAT([] { ContactBody(nullptr); }, ThrowsMessage<std::invalid_argument>(HasSubstr("needs a mesh")));
  EXPECT_THROW(SlidingPart(nullptr), std::invalid_argument);
}

TEST_F(ContactPreconditions, EitherMethodNeedsAPartAndBodies) {
  for (const reference::SlidingMethod method :
       {reference::SlidingMethod::kProjection, reference::SlidingMethod::kPaper}) {
    EXPECT_THAT([&] { reference::make_sliding(method, {block_}, nullptr, above()); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("the part needs a body")));
    EXPECT_THAT([&] { reference::make_sliding(method, {{.body = nullptr, .name = "the wall"}}, part_, above()); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("the wall needs a body")));
  }
}

TEST_F(ContactPreconditions, AScriptedPartNeedsABody) {
  const geometry::PoseTrajectory script({{std::chrono::nanoseconds(0), above()}});
  EXPECT_THAT(
      [&] { Sliding({block_}, part_, above(), {}, {{.part_B = nullptr, .script_X_WB = script, .name = "the lift"}}); },
      ThrowsMessage<std::invalid_argument>(HasSubstr("the lift needs a body")));
}

TEST_F(ContactPreconditions, RulesAreInRange) {
  EXPECT_THROW(Sliding({block_}, part_, above(), {.rules = {.max_cycles = 0}}), std::invalid_argument);
  EXPECT_THROW(Sliding({block_}, part_, above(), {.rules = {.contacts_ahead_ms = -1.0}}), std::invalid_argument);
  EXPECT_THROW(Sliding({block_}, part_, above(), {.rules = {.affordable_pairs = 0}}), std::invalid_argument);
}

TEST_F(ContactPreconditions, ThereIsAPoseForEachPart) {
  if (!test_support::kHasAssertions) GTEST_SKIP() << "built without GLISSADE_ASSERTIONS";
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  MultiPartSliding sliding({block_}, {{.part_V = part_, .X_WV_start = above()}});
  const std::vector<Isometry3d> none;
  EXPECT_DEATH(sliding.advance(none), "precondition");
  EXPECT_DEATH(sliding.release(1), "precondition");
  EXPECT_DEATH(sliding.advance(std::vector{above()}, -1.0), "precondition");
}

}  // namespace
}  // namespace glissade::contact
