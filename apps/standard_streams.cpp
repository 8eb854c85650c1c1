#include <fcntl.h>
#include <unistd.h>

#include <glissade/apps/standard_streams.h>

namespace glissade::apps {

void complete_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) != -1) continue;
    // The lowest number that is free is that of the stream. What is open for reading alone fails to be written.
    if (open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY) != stream) return;
  }
}

}  // namespace glissade::apps
