/// The examples in helps that talk to another process work as they are pasted, in a network namespace of their own.

#include <cstdlib>

#include <gtest/gtest.h>

#include "help_examples.h"
#include "sanitizers.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

TEST(HelpExamplesWithANetwork, WorkAsTheyArePasted) {
  ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
  const test_support::TemporaryFolder folder;
  ASSERT_EQ(test_support::run_example("glissade example", folder).exit_code, 0);
  // In this order: one of 'replay' leads a server with what one of 'demo' recorded.
  for (const std::string& command : test_support::kCommands) {
    for (const std::string& example : test_support::examples_of(command)) {
      // Under a sanitizer the car door and hands take minutes; other tests run the same code.
      const bool is_slow = command == "latency" || example.find("square_peg") == std::string::npos;
      if (!test_support::needs_network(example) || (test_support::kSanitized && is_slow)) continue;
      SCOPED_TRACE(example);
      const test_support::ProgramResult result = test_support::run_example(example, folder);
      const bool is_too_fast = result.standard_error.find("missed its goal") != std::string::npos;
      EXPECT_LE(result.exit_code, is_too_fast ? 1 : 0) << result.standard_error;
    }
  }
}

}  // namespace
}  // namespace glissade::apps
