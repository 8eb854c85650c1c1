#pragma once

/// A line on standard error about work that takes long and whose amount is not known.

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace glissade::apps {

/// Says once what the program does, such as "reading door.stl", if this object exists for two seconds.
class WaitNotice {
 public:
  explicit WaitNotice(std::string doing);
  ~WaitNotice();
  WaitNotice(const WaitNotice&) = delete;
  WaitNotice& operator=(const WaitNotice&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable ended_;
  bool has_ended_ = false;
  std::thread thread_;
};

}  // namespace glissade::apps
