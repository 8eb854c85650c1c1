#include <algorithm>

#include <fcntl.h>
#include <sys/ioctl.h>

#include <glissade/apps/run/status_line.h>
#include <glissade/apps/say.h>

namespace glissade::apps {

namespace {

constexpr const char* kEraseLine = "\r\033[K";

/// The last column stays empty: some terminals begin a new line after it.
std::size_t usable_columns(int terminal) {
  constexpr std::size_t kUsual = 80;
  winsize size{};
  const bool is_known = ioctl(terminal, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return (is_known ? size.ws_col : kUsual) - 1;
}

}  // namespace

StatusLine::StatusLine(int descriptor) : descriptor_(descriptor) {
  if (isatty(descriptor) != 1) return;
  // Opened anew: that this program does not wait must not change how the shell writes to the same terminal.
  const std::string path = "/proc/self/fd/" + std::to_string(descriptor);
  terminal_ = open(path.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
}

StatusLine::~StatusLine() {
  show({});
  if (terminal_ >= 0) close(terminal_);
}

void StatusLine::show(std::string_view text) {
  if (terminal_ < 0 || (text.empty() && shown_.empty())) return;
  shown_ = cut_to_width(text, usable_columns(terminal_));
  write_to_terminal(kEraseLine + shown_);
}

void StatusLine::say(std::string_view sentence) {
  if (terminal_ < 0) {
    apps::say(sentence, descriptor_);
  } else {
    write_to_terminal(kEraseLine + std::string(sentence) + '\n' + shown_);
  }
}

void StatusLine::write_to_terminal(const std::string& text) const {
  // What a full terminal does not take has no other place to go.
  [[maybe_unused]] const ssize_t written = write(terminal_, text.data(), text.size());
}

std::string_view cut_to_width(std::string_view text, std::size_t columns) {
  std::size_t end = 0;
  for (std::size_t characters = 0; end < text.size(); ++end) {
    const bool begins_character = (static_cast<unsigned char>(text[end]) & 0xc0U) != 0x80U;
    if (begins_character && ++characters > columns) break;
  }
  return text.substr(0, end);
}

}  // namespace glissade::apps
