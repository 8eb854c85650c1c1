#pragma once

/// Ctrl-C as a wish to end, for commands that run until they are told to stop.

namespace glissade::apps {

/// From its construction on, the first SIGINT or SIGTERM does not end the process but makes `requested()` true; the
/// second ends it, so that a command that does not come to its end can be stopped. One per process.
class StopSignal {
 public:
  StopSignal();

  /// Any thread.
  static bool requested();
};

}  // namespace glissade::apps
