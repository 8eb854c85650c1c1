/// Which devices a bridge uses, and what it says when it cannot.

#include "haply/arm_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/bridges/wire.h>

namespace glissade::bridges {
namespace {

using testing::HasSubstr;

ServiceMessage with_arms(const std::vector<std::string>& ids) {
  ServiceMessage message;
  for (const std::string& id : ids)
    message.arms.push_back({.id = id});
  return message;
}

template <typename Call>
std::string refusal_of(const Call& call) {
  try {
    call();
  } catch (const WireError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(ArmChoice, TakesTheOnlyArmOrTheOneThatIsAskedFor) {
  EXPECT_EQ(chosen_arm(with_arms({"A"}), "").id, "A");
  EXPECT_EQ(chosen_arm(with_arms({"A", "B"}), "B").id, "B");
}

TEST(ArmChoice, SaysWhatThereIs) {
  EXPECT_THAT(refusal_of([] { chosen_arm({}, ""); }), HasSubstr("no Inverse3; is it plugged in"));
  EXPECT_THAT(refusal_of([] { chosen_arm(with_arms({"A"}), "C"); }), HasSubstr("no Inverse3 'C'"));
  EXPECT_THAT(refusal_of([] { chosen_arm(with_arms({"A", "B"}), ""); }), HasSubstr("one of A, B by --arm"));
}

TEST(ArmChoice, NeedsNoHandle) {
  EXPECT_EQ(chosen_handle({}, ""), nullptr);
  ServiceMessage two;
  two.handles = {{.id = "X"}, {.id = "Y"}};
  EXPECT_THAT(refusal_of([&] { chosen_handle(two, ""); }), HasSubstr("one of X, Y by --handle"));
  EXPECT_EQ(chosen_handle(two, "Y")->id, "Y");
}

TEST(ArmChoice, SaysWhatKeepsAnArmFromBeingUsed) {
  HaplyArm arm{.id = "A", .config = ArmConfig{.type = "inverse3"}};
  EXPECT_EQ(trouble_of(arm), "");
  arm.status.is_calibrated = false;
  EXPECT_THAT(trouble_of(arm), HasSubstr("device A is not calibrated"));
  arm.status.has_power = false;
  EXPECT_THAT(trouble_of(arm), HasSubstr("no power"));
  arm.config->type = "minverse";
  EXPECT_THAT(trouble_of(arm), HasSubstr("'minverse'"));
}

}  // namespace
}  // namespace glissade::bridges
