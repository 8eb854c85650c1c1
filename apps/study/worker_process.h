#pragma once

/// A process that runs slides of a study. If a slide crashes, only this process ends.

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

#include <sys/types.h>

namespace glissade::apps {

/// Not thread-safe; different objects may be used in different threads.
class WorkerProcess {
 public:
  /// The option of `glissade study` that makes the program a worker: see `serve_slides`.
  static constexpr const char* kOption = "--worker";
  /// The option for the folder with the pages of the slides.
  static constexpr const char* kPagesOption = "--worker-pages";

  /// Starts the program again, as a worker of this study. With a folder `pages`, it writes the page of each slide
  /// there: see `page_folder`. The worker ends with the thread that called the constructor. Throws std::system_error
  /// when the system refuses a process.
  WorkerProcess(const std::string& study_file, const std::string& pages);
  /// Kills the worker.
  ~WorkerProcess();
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  enum class Outcome : std::uint8_t { kDone, kNotStarted, kDied, kTooLong, kStopped };
  struct Answer {
    Outcome outcome;
    std::string json{};    ///< if it is done
    std::string reason{};  ///< if the worker died or has not started: how it ended
  };
  /// Waits for the row of a slide, at most for this time after the worker has read the study. Returns early if
  /// `should_stop` is true. If the outcome is not `kDone`, this object is of no more use.
  Answer run(std::int64_t slide, std::chrono::nanoseconds longest, const std::function<bool()>& should_stop);

 private:
  using Clock = std::chrono::steady_clock;

  Answer receive(Clock::time_point end, const std::function<bool()>& should_stop);
  std::string reason_of_death();

  int socket_ = -1;
  pid_t id_ = -1;
  bool is_ready_ = false;
  std::string received_{};
};

/// The work of a worker: it writes a line when it is ready. Then, for each line on the standard input, the number of a
/// slide, it writes `row(number)` to the standard output as a line. Returns at the end of the input.
void serve_slides(const std::function<std::string(std::int64_t)>& row);

}  // namespace glissade::apps
