#include <gtest/gtest.h>

#include <glissade/apps/progress.h>

namespace glissade::apps {
namespace {

TEST(ProgressLine, FillsFromEmptyToFull) {
  EXPECT_EQ(progress_line("poses", 0, 200, 4), "poses [    ]   0 %");
  EXPECT_EQ(progress_line("poses", 100, 200, 4), "poses [##  ]  50 %");
  EXPECT_EQ(progress_line("poses", 200, 200, 4), "poses [####] 100 %");
}

TEST(ProgressLine, NeverLeavesItsBar) {
  EXPECT_EQ(progress_line("poses", 900, 200, 4), "poses [####] 100 %");
}

}  // namespace
}  // namespace glissade::apps
