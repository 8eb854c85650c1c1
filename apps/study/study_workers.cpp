#include <algorithm>
#include <atomic>
#include <exception>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

#include <glissade/apps/study/study_workers.h>
#include <glissade/apps/study/worker_process.h>
#include <glissade/apps/text.h>
#include <glissade/study/slide_row.h>

namespace glissade::apps {
namespace {

/// The threads that each lead one process.
class Workers {
 public:
  Workers(const study::Study& study, const study::SlideRunner& runner, const StudyWork& work)
      : study_(study), runner_(runner), work_(work) {}

  void run() {
    {
      std::vector<std::jthread> threads;
      for (int i = 0; i < work_.workers; ++i)
        threads.emplace_back([this] { lead(); });
    }
    if (error_) std::rethrow_exception(error_);
  }

 private:
  /// Runs slides in a process until there are no more. A process that has died is replaced.
  void lead() {
    try {
      std::unique_ptr<WorkerProcess> process;
      while (const std::optional<std::int64_t> slide = next()) {
        const std::optional<std::string> json = row_of(*slide, process);
        if (!json) return;
        const std::lock_guard lock(mutex_);
        work_.take(*slide, *json);
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!error_) error_ = std::current_exception();
      has_failed_ = true;
    }
  }

  std::optional<std::int64_t> next() {
    const std::lock_guard lock(mutex_);
    return should_stop() ? std::nullopt : work_.next();
  }

  bool should_stop() const { return has_failed_ || work_.should_stop(); }

  /// None if the work is to stop.
  std::optional<std::string> row_of(std::int64_t slide, std::unique_ptr<WorkerProcess>& process) {
    constexpr int kTrials = 3;
    std::string problem;
    std::string death;
    for (int trial = 0; trial < kTrials; ++trial) {
      if (!process) process = std::make_unique<WorkerProcess>(work_.study_file, work_.pages);
      const WorkerProcess::Answer answer = process->run(slide, work_.longest, [this] { return should_stop(); });
      if (answer.outcome == WorkerProcess::Outcome::kDone) return answer.json;
      process.reset();
      if (answer.outcome == WorkerProcess::Outcome::kStopped) return std::nullopt;
      if (answer.outcome == WorkerProcess::Outcome::kTooLong) {
        problem = study::too_long(std::chrono::duration<double>(work_.longest).count());
        break;
      }
      if (answer.outcome == WorkerProcess::Outcome::kNotStarted) {
        problem.clear();
        death = answer.reason;
        continue;
      }
      problem = "the process of the slide was " + answer.reason + ", " + std::to_string(kTrials) + " times";
    }
    if (problem.empty()) throw std::runtime_error("the worker processes cannot start: the last one was " + death);
    return study::json_of(study_, runner_.not_run(slide, problem));
  }

  const study::Study& study_;
  const study::SlideRunner& runner_;
  const StudyWork& work_;
  std::mutex mutex_;
  std::atomic<bool> has_failed_ = false;
  std::exception_ptr error_;
};

}  // namespace

void run_slides(const study::Study& study, const study::SlideRunner& runner, const StudyWork& work) {
  Workers(study, runner, work).run();
}

}  // namespace glissade::apps
