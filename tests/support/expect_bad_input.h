#pragma once

/// Checks of errors for bad input: the right type, and a message on one line that names the fault.

#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace glissade::test_support {

/// Expects that `call` throws std::invalid_argument with a one-line message that contains all of `parts`.
template <typename Call>
void expect_bad_input(Call call, const std::vector<std::string>& parts) {
  try {
    call();
    ADD_FAILURE() << "nothing was thrown";
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();
    for (const std::string& part : parts)
      EXPECT_THAT(message, testing::HasSubstr(part));
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

}  // namespace glissade::test_support
