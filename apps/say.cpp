#include <string>

#include <poll.h>
#include <unistd.h>

#include <glissade/apps/say.h>

namespace glissade::apps {

void say(std::string_view line) {
  pollfd standard_error{.fd = STDERR_FILENO, .events = POLLOUT, .revents = 0};
  if (poll(&standard_error, 1, 0) != 1 || (standard_error.revents & POLLOUT) == 0) return;
  const std::string text = std::string(line) + '\n';
  // A pipe that is ready takes a short line as a whole. What cannot be written has no other place to go.
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text.data(), text.size());
}

}  // namespace glissade::apps
