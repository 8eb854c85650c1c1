#pragma once

/// Ctrl-C as a request to stop, for commands that run until the user ends them.

namespace glissade::apps {

/// After construction, the first SIGINT, SIGTERM, SIGHUP or SIGQUIT makes `requested()` true instead of ending the
/// process. Others are ignored as long as a force may still fade; two seconds after the first, the next one ends the
/// process, in case the command does not react. A reader of the output that goes away and a file that reaches the limit
/// of its size are errors of that output and no longer end the process, nor do signals without a meaning. One per
/// process.
class StopSignal {
 public:
  StopSignal();

  /// For any thread.
  static bool requested();
};

}  // namespace glissade::apps
