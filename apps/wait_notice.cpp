#include <chrono>
#include <system_error>
#include <utility>

#include <glissade/apps/progress.h>
#include <glissade/apps/say.h>
#include <glissade/apps/text.h>
#include <glissade/apps/wait_notice.h>

namespace glissade::apps {

WaitNotice::WaitNotice(std::string doing) {
  const auto wait = [this, doing = std::move(doing)] {
    std::unique_lock lock(mutex_);
    const bool is_short = ended_.wait_for(lock, std::chrono::seconds(2), [this] { return has_ended_; });
    if (!is_short && !is_quiet()) say("glissade: " + one_line(doing) + " ...");
  };
  try {
    thread_ = std::thread(wait);
  } catch (const std::system_error&) {
    // Without another thread there is no notice.
  }
}

WaitNotice::~WaitNotice() {
  if (!thread_.joinable()) return;
  {
    const std::scoped_lock lock(mutex_);
    has_ended_ = true;
  }
  ended_.notify_one();
  thread_.join();
}

}  // namespace glissade::apps
