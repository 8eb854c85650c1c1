#pragma once

namespace glissade::apps {

/// After construction, SIGUSR1 is a request for what the flight recorder keeps. One per process.
class DumpSignal {
 public:
  DumpSignal();

  /// Whether a request has come since the last call. Any thread.
  static bool take();
};

}  // namespace glissade::apps
