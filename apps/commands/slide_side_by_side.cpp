#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <future>
#include <stop_token>
#include <thread>

#include <glissade/apps/commands/slide_side_by_side.h>
#include <glissade/apps/progress.h>
#include <glissade/reference/sliding_method.h>

namespace glissade::apps {

namespace {

std::int64_t steps_of(const FollowedTrajectory& trajectory) {
  return trajectory.duration() / std::chrono::milliseconds(1) + 1;
}

}  // namespace

void check_side_by_side(const HapticScene& scene, std::vector<FollowedTrajectory> trajectories,
                        const std::vector<std::string>& files, const SlideCheckOptions& options,
                        const std::function<void(SlideCheck)>& take) {
  std::atomic<std::int64_t> done = 0;
  std::int64_t total = 0;
  std::vector<std::packaged_task<SlideCheck()>> tasks;
  std::vector<std::future<SlideCheck>> checks;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::int64_t steps = steps_of(trajectories[i]);
    total += steps;
    tasks.emplace_back([&, i, steps] {
      SlideCheck check = check_slide(scene, trajectories[i], files[i], options,
                                     [&](std::chrono::nanoseconds, const reference::SlidingSimulation&) { ++done; });
      if (check.problem) done += steps;
      return check;
    });
    checks.push_back(tasks.back().get_future());
  }
  std::atomic<std::size_t> next = 0;
  std::vector<std::jthread> helpers;
  while (helpers.size() < std::min<std::size_t>(std::max(1U, std::thread::hardware_concurrency()), files.size())) {
    helpers.emplace_back([&](const std::stop_token& stop) {
      for (std::size_t i = next++; i < tasks.size() && !stop.stop_requested(); i = next++)
        tasks[i]();
    });
  }
  ProgressBar progress("checking", total, simulated_time);
  for (std::future<SlideCheck>& check : checks) {
    constexpr std::chrono::milliseconds kRedrawPeriod{100};
    while (check.wait_for(kRedrawPeriod) != std::future_status::ready)
      progress.update(done);
    progress.erase();
    take(check.get());
  }
}

}  // namespace glissade::apps
