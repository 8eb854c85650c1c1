#pragma once

/// A program that runs beside the test.

#include <string>
#include <vector>

#include <sys/types.h>

#include "temporary_folder.h"

namespace glissade::test_support {

/// How a program ended.
struct ProgramResult {
  int exit_code;  ///< negative signal number when a signal ended it
  std::string standard_output;
  std::string standard_error;
};

class Process {
 public:
  /// Starts `arguments[0]` with the rest as its arguments and an empty standard input. Throws std::system_error when it
  /// cannot be started.
  explicit Process(const std::vector<std::string>& arguments);
  /// Kills the program if it still runs.
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void signal(int number) const;
  /// Sends a signal to the thread of this name. Throws std::runtime_error if there is none.
  void signal_thread(const std::string& name, int number) const;
  /// What it has written to standard error so far.
  std::string standard_error() const;
  /// Waits for its end.
  ProgramResult wait();

 private:
  // Files, not pipes: the program can never block on a reader that waits for its other stream.
  TemporaryFolder folder_;
  pid_t id_ = 0;
  bool is_running_ = false;
};

}  // namespace glissade::test_support
