#include <algorithm>
#include <cstddef>

#include <glissade/apps/latency/machine_load.h>
#include <glissade/realtime/periodic_thread.h>

namespace glissade::apps {

namespace {

constexpr std::size_t kMebibytes = 16;

unsigned load_threads() {
  return std::max(1U, std::thread::hardware_concurrency());
}

}  // namespace

MachineLoad::MachineLoad() {
  for (unsigned i = 0; i < load_threads(); ++i) {
    threads_.emplace_back([this] {
      realtime::name_this_thread("load");
      std::vector<double> numbers((kMebibytes << 20) / sizeof(double), 1.0);
      while (!should_end_.load(std::memory_order_relaxed)) {
        for (double& number : numbers)
          number = 0.999 * number + 1e-3;
      }
    });
  }
}

MachineLoad::~MachineLoad() {
  should_end_.store(true, std::memory_order_relaxed);
  for (std::thread& thread : threads_)
    thread.join();
}

std::string machine_load_text() {
  return std::to_string(load_threads()) + " threads of ordinary priority, each at work on " +
         std::to_string(kMebibytes) + " MiB of memory";
}

}  // namespace glissade::apps
