#pragma once

/// Runs a program as its users do and keeps its output.

#include <string>
#include <vector>

namespace glissade::test_support {

/// How a program ended.
struct ProgramResult {
  int exit_code;  ///< negative signal number when a signal ended it
  std::string standard_output;
  std::string standard_error;
};

/// Runs `arguments[0]` with the rest as its arguments and an empty standard input, and waits for its end.
/// Throws std::system_error when it cannot be started.
ProgramResult run_program(const std::vector<std::string>& arguments);

}  // namespace glissade::test_support
