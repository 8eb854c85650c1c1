#pragma once

/// Ctrl-C as a request to stop, for commands that run until the user ends them.

namespace glissade::apps {

/// After construction, the first SIGINT or SIGTERM makes `requested()` true instead of ending the process. The second
/// ends the process, in case the command does not react. A reader of the output that goes away and a file that reaches
/// the limit of its size are errors of that output and no longer end the process. One per process.
class StopSignal {
 public:
  StopSignal();

  /// For any thread.
  static bool requested();
};

}  // namespace glissade::apps
