#pragma once

/// Whether the library checks its preconditions, for tests that break them.

#include <gtest/gtest.h>

namespace glissade::test_support {

#ifdef GLISSADE_ASSERTIONS
inline constexpr bool kHasAssertions = true;
#else
inline constexpr bool kHasAssertions = false;
#endif

/// A test that breaks preconditions and expects death; skips where they are not checked.
class Preconditions : public testing::Test {
 protected:
  void SetUp() override {
    if (!kHasAssertions) GTEST_SKIP() << "built without GLISSADE_ASSERTIONS";
    GTEST_FLAG_SET(death_test_style, "threadsafe");
  }
};

}  // namespace glissade::test_support
