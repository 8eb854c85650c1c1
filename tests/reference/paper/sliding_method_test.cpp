// The methods of sliding by name, and the one place that makes them.

#include <limits>
#include <memory>
#include <stdexcept>

#include <gtest/gtest.h>

#include <glissade/contact/sliding.h>
#include <glissade/contact/spring.h>
#include <glissade/geometry/mesh_generators.h>

#include "paper/paper_sliding.h"

namespace glissade::reference {
namespace {

std::unique_ptr<SlidingSimulation> box_above_floor(SlidingMethod method, double height,
                                                   const contact::SlidingOptions& options) {
  const auto mesh = [](const geometry::TriangleMesh& m) { return std::make_shared<geometry::TriangleMesh>(m); };
  return make_sliding(method, {{std::make_shared<contact::ContactBody>(mesh(geometry::make_plate({0.5, 0.5}, 2)))}},
                      std::make_shared<contact::SlidingPart>(mesh(geometry::make_box({0.1, 0.06, 0.04}, 12))),
                      Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, height)), options);
}

TEST(SlidingMethod, HasItsNameOnTheCommandLine) {
  EXPECT_EQ(sliding_method_from_name("projection"), SlidingMethod::kProjection);
  EXPECT_EQ(sliding_method_from_name("paper"), SlidingMethod::kPaper);
  EXPECT_FALSE(sliding_method_from_name("glue").has_value());
  for (const std::string_view name : kSlidingMethodNames)
    EXPECT_EQ(name_of(sliding_method_from_name(name).value()), name);
}

TEST(SlidingMethod, MakesTheSimulationOfItsName) {
  const auto projection =
      box_above_floor(SlidingMethod::kProjection, 0.1, {.metaphor = contact::Metaphor::kForceFeedback});
  const auto paper = box_above_floor(SlidingMethod::kPaper, 0.1, {.metaphor = contact::Metaphor::kForceFeedback});
  EXPECT_EQ(dynamic_cast<PaperSliding*>(projection.get()), nullptr);
  EXPECT_NE(dynamic_cast<PaperSliding*>(paper.get()), nullptr);
  EXPECT_EQ(projection->stiffness().translational, paper->stiffness().translational);
  EXPECT_EQ(projection->stiffness().rotational, paper->stiffness().rotational);
}

TEST(SlidingMethod, HandsTheMetaphorOn) {
  const Eigen::Isometry3d X_WG =
      Eigen::Translation3d(0.01, 0.0, 0.1) * Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX());
  for (const SlidingMethod method : {SlidingMethod::kProjection, SlidingMethod::kPaper}) {
    const auto band = box_above_floor(method, 0.1, {.metaphor = contact::Metaphor::kRubberBand});
    EXPECT_EQ(band->advance(X_WG).X_WV.linear(), Eigen::Matrix3d::Identity()) << "the ghost does not turn it";
    const auto spring = box_above_floor(method, 0.1, {.metaphor = contact::Metaphor::kRubberBandSpring});
    EXPECT_EQ(spring->advance(X_WG).X_WV.matrix(), X_WG.matrix()) << name_of(method);
  }
}

TEST(SlidingMethod, RefusesAStartThatCollidesWhateverTheMethod) {
  for (const SlidingMethod method : {SlidingMethod::kProjection, SlidingMethod::kPaper})
    EXPECT_THROW(box_above_floor(method, 0.01, {.metaphor = contact::Metaphor::kForceFeedback}), std::invalid_argument);
}

TEST(SlidingMethod, RefusesAStiffnessThatIsNotPositiveWhateverTheMethod) {
  for (const SlidingMethod method : {SlidingMethod::kProjection, SlidingMethod::kPaper}) {
    for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
      EXPECT_THROW(box_above_floor(method, 0.1, {.stiffness = contact::CouplingStiffness{1000.0, bad}}),
                   std::invalid_argument);
  }
}

}  // namespace
}  // namespace glissade::reference
