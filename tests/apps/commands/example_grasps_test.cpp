/// The hands of `glissade example`: each grasps its thing and lifts it.

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/apps/commands/example_grasps.h>
#include <glissade/apps/text.h>
#include <glissade/files/text_file.h>

#include "glissade_program.h"
#include "sanitizers.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using test_support::CsvRow;
using test_support::glissade;
using test_support::ProgramResult;
using test_support::rows_of;

std::vector<std::string> things_to_grasp() {
  std::vector<std::string> things;
  for (const TextFile& file : example_grasps()) {
    const std::size_t end = file.path.find(".yaml");
    if (end != std::string::npos) things.push_back(file.path.substr(6, end - 6));
  }
  return things;
}

TEST(ExampleGrasps, AreOfTenThings) {
  EXPECT_EQ(things_to_grasp().size(), 10U);
  EXPECT_EQ(example_grasps().size(), 20U);
}

class ExampleGrasp : public testing::TestWithParam<std::string> {};

TEST_P(ExampleGrasp, EndsInAHold) {
  if (test_support::kSanitized) GTEST_SKIP() << "takes minutes; the tests of grasps run through the same code";
  const test_support::TemporaryFolder folder;
  for (const TextFile& file : example_grasps())
    folder.write(file.path, file.text);
  const std::string hands = folder.path("hands.csv");
  const std::string objects = folder.path("objects.csv");
  const ProgramResult run =
      glissade({"grasp", folder.path("grasp_" + GetParam() + ".yaml"), "--hand-trajectory",
                folder.path("grasp_" + GetParam() + "_hand.csv"), "--out", hands, "--objects", objects});
  ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  EXPECT_EQ(run.standard_error, "") << "nothing is warned of";
  const std::vector<CsvRow> postures = rows_of(read_text_file(hands));
  EXPECT_EQ(postures.front().at("state"), "free");
  EXPECT_EQ(postures.back().at("state"), "holding") << run.standard_output;
  EXPECT_EQ(postures.back().at("object"), GetParam());
  const std::vector<CsvRow> moved = rows_of(read_text_file(objects));
  EXPECT_GT(std::stod(moved.back().at("z_m")) - std::stod(moved.front().at("z_m")), 0.05) << "it is lifted";
}

INSTANTIATE_TEST_SUITE_P(Things, ExampleGrasp, testing::ValuesIn(things_to_grasp()),
                         [](const auto& thing) { return thing.param; });

}  // namespace
}  // namespace glissade::apps
