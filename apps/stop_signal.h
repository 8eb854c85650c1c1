#pragma once

/// Ctrl-C as a wish to end, for commands that run until they are told to stop.

namespace glissade::apps {

/// From its construction on, SIGINT and SIGTERM no longer end the process but make `requested()` true. One per process.
class StopSignal {
 public:
  StopSignal();

  /// Any thread.
  static bool requested();
};

}  // namespace glissade::apps
