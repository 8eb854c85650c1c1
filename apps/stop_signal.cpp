#include <csignal>

#include <glissade/apps/stop_signal.h>

namespace glissade::apps {

namespace {

volatile std::sig_atomic_t stop_requested = 0;

void on_signal(int) {
  stop_requested = 1;
}

}  // namespace

StopSignal::StopSignal() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

bool StopSignal::requested() {
  return stop_requested != 0;
}

}  // namespace glissade::apps
