#include <iostream>
#include <string>

#include <poll.h>

#include <glissade/apps/say.h>
#include <glissade/apps/text.h>

namespace glissade::apps {

void say(std::string_view line, int descriptor) {
  pollfd output{.fd = descriptor, .events = POLLOUT, .revents = 0};
  if (poll(&output, 1, 0) != 1 || (output.revents & POLLOUT) == 0) return;
  const std::string text = std::string(line) + '\n';
  // A pipe that is ready takes a short line as a whole. What cannot be written has no other place to go.
  [[maybe_unused]] const ssize_t written = write(descriptor, text.data(), text.size());
}

void warn(const std::string& sentence) {
  std::cerr << "glissade: warning: " << one_line(sentence) << '\n';
}

}  // namespace glissade::apps
