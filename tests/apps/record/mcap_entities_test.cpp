// The entity of contacts and forces. What a whole recording gives is checked in viewer/page/test/mcap.test.mjs.

#include <array>
#include <chrono>
#include <numbers>
#include <optional>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <glissade/apps/record/mcap_entities.h>

namespace glissade::apps {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Vector3d vector_of(const nlohmann::json& json) {
  return {json.at("x").get<double>(), json.at("y").get<double>(), json.at("z").get<double>()};
}

/// From the tail of an arrow to its tip.
Vector3d arrow_vector(const nlohmann::json& arrow) {
  const nlohmann::json& q = arrow.at("pose").at("orientation");
  const double length = arrow.at("shaft_length").get<double>() + arrow.at("head_length").get<double>();
  return Eigen::Quaterniond(q.at("w"), q.at("x"), q.at("y"), q.at("z")) * Vector3d(length, 0.0, 0.0);
}

Vector3d place_of(const nlohmann::json& primitive) {
  return vector_of(primitive.at("pose").at("position"));
}

/// A part that is turned by a right angle about z, and a hand that holds nothing.
class McapContacts : public testing::Test {
 protected:
  McapContacts() {
    state.parts[0].X_WV =
        Eigen::Translation3d(1.0, 2.0, 3.0) * Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitZ());
    state.parts[0].p_Vref = Vector3d(0.5, 0.0, 0.0);
    X_WH[0] = Isometry3d(Eigen::Translation3d(7.0, 8.0, 9.0));
  }

  nlohmann::json entity() const {
    const nlohmann::json update = contacts_update(state, X_WH);
    EXPECT_EQ(update.at("entities").size(), 1U);
    EXPECT_EQ(update.at("entities")[0].at("id"), "contacts");
    return update.at("entities")[0];
  }

  devices::HapticState state;
  std::array<std::optional<Isometry3d>, devices::kHapticHands> X_WH;
};

TEST_F(McapContacts, WithoutContactsAndForcesTheEntityIsEmpty) {
  const nlohmann::json empty = entity();
  EXPECT_TRUE(empty.at("spheres").empty());
  EXPECT_TRUE(empty.at("arrows").empty());
}

TEST_F(McapContacts, PatchesAreShownWhereContactsLack) {
  state.patch_count = 1;
  state.patches[0] = {.p_V = {0.25F, 0.0F, 0.0F}, .n_W = {0.0F, 0.0F, -1.0F}};
  nlohmann::json shown = entity();
  ASSERT_EQ(shown.at("spheres").size(), 1U);
  EXPECT_TRUE(place_of(shown.at("spheres")[0]).isApprox(Vector3d(1.0, 2.25, 3.0), 1e-12));
  ASSERT_EQ(shown.at("arrows").size(), 1U);
  EXPECT_TRUE(place_of(shown.at("arrows")[0]).isApprox(Vector3d(1.0, 2.25, 3.0), 1e-12));
  EXPECT_TRUE(arrow_vector(shown.at("arrows")[0]).isApprox(Vector3d(0.0, 0.0, -0.03), 1e-12));

  state.contact_count = 2;
  state.contacts[0] = {.p_V = {0.0F, 0.5F, 0.0F}, .n_W = {-1.0F, 0.0F, 0.0F}};
  state.contacts[1] = {.p_V = {0.0F, 0.0F, 0.5F}, .n_W = {0.0F, 1.0F, 0.0F}};
  shown = entity();
  ASSERT_EQ(shown.at("spheres").size(), 2U);
  EXPECT_TRUE(place_of(shown.at("spheres")[0]).isApprox(Vector3d(0.5, 2.0, 3.0), 1e-12));
  EXPECT_TRUE(arrow_vector(shown.at("arrows")[0]).isApprox(Vector3d(-0.03, 0.0, 0.0), 1e-12)) << "against x";
  EXPECT_TRUE(arrow_vector(shown.at("arrows")[1]).isApprox(Vector3d(0.0, 0.03, 0.0), 1e-12));
}

TEST_F(McapContacts, AForceStartsAtThePartThatIsHeldOrAtTheRoot) {
  state.hands[0].force_W = Vector3d(3.0, 0.0, -4.0);
  const nlohmann::json free = entity();
  ASSERT_EQ(free.at("arrows").size(), 1U);
  EXPECT_EQ(place_of(free.at("arrows")[0]), Vector3d(7.0, 8.0, 9.0));
  EXPECT_TRUE(arrow_vector(free.at("arrows")[0]).isApprox(Vector3d(0.03, 0.0, -0.04), 1e-12)) << "10 mm a newton";

  state.hands[0].part = 0;
  EXPECT_TRUE(place_of(entity().at("arrows")[0]).isApprox(Vector3d(1.0, 2.5, 3.0), 1e-12));

  state.hands[0].part = -1;
  X_WH[0].reset();
  EXPECT_TRUE(entity().at("arrows").empty()) << "nobody knows where the hand is";
}

}  // namespace
}  // namespace glissade::apps
