/// The passing of a value between two threads: this library's buffers beside a mutex and Boost's queue.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>

#include <benchmark/benchmark.h>

#include <glissade/devices/glove_device.h>
#include <glissade/devices/haptic_state.h>
#include <glissade/haptics/contact_set.h>

#include "bench_program.h"
#include "call_times.h"
#include "handoffs.h"

namespace glissade::bench {
namespace {

using Clock = std::chrono::steady_clock;

/// What the library passes on, with the moment at which it was published.
template <typename Payload>
struct Stamped {
  Clock::time_point published;
  Payload payload;
};

/// A publish and a take in one thread.
template <typename Value, typename Handoff>
void run_one_thread(benchmark::State& state) {
  const auto handoff = std::make_unique<Handoff>();
  const auto value = std::make_unique<Value>();
  for (auto _ : state) {
    handoff->publish(*value);
    handoff->take(*value);
  }
  state.counters["size_B"] = sizeof(Value);
}

/// Waits for `condition` on a processor. Where the two threads of the bench share one, the other gets its turn.
template <typename Condition>
void spin_until(const Condition& condition) {
  constexpr int kPatience = 2000;
  for (int i = 1; !condition(); ++i) {
    if (i % kPatience == 0) std::this_thread::yield();
  }
}

/// What two threads share.
template <typename Handoff>
struct Meeting {
  Handoff handoff;
  std::atomic<std::int64_t> taken{0};
};

/// One thread publishes when the other has taken the last value, which it looks for without a pause. Counters of the
/// time of a publish, and of that from before the publish until the other thread has taken the value.
template <typename Value, typename Handoff>
void run_two_threads(benchmark::State& state, std::unique_ptr<Meeting<Handoff>>& meeting) {
  const bool is_writer = state.thread_index() == 0;
  if (is_writer) meeting = std::make_unique<Meeting<Handoff>>();  // before the threads meet at the start of the loop
  const auto value = std::make_unique<Value>();
  CallTimes times;
  std::int64_t count = 0;
  for (auto _ : state) {
    ++count;
    if (is_writer) {
      value->published = Clock::now();
      meeting->handoff.publish(*value);
      times.record(Clock::now() - value->published);
      spin_until([&] { return meeting->taken.load(std::memory_order_acquire) >= count; });
    } else {
      spin_until([&] { return meeting->handoff.take(*value); });
      times.record(Clock::now() - value->published);
      meeting->taken.store(count, std::memory_order_release);
    }
  }
  times.report_ns(state, is_writer ? "publish_" : "handoff_");
}

template <typename Value, typename Handoff>
void register_handoff(const std::string& name, bool quick) {
  const auto name_of = [&](const char* threads) { return "handoff/" + name + threads + "/" + Handoff::kSubject; };
  benchmark::RegisterBenchmark(name_of("-one-thread").c_str(), run_one_thread<Value, Handoff>);
  const int handoffs = (sizeof(Value) > 4096 ? 500 : 5000) / (quick ? 2 : 1);  // enough for a quantile
  const auto meeting = std::make_shared<std::unique_ptr<Meeting<Handoff>>>();
  benchmark::RegisterBenchmark(name_of("-two-threads").c_str(),
                               [=](benchmark::State& state) { run_two_threads<Value>(state, *meeting); })
      ->Threads(2)
      ->Iterations(handoffs)
      ->UseRealTime();
}

template <typename Payload>
void register_handoffs_of(const std::string& name, bool quick) {
  using Value = Stamped<Payload>;
  register_handoff<Value, TripleBufferHandoff<Value>>(name, quick);
  register_handoff<Value, RingHandoff<Value>>(name, quick);
  register_handoff<Value, MutexHandoff<Value>>(name, quick);
  register_handoff<Value, BoostHandoff<Value>>(name, quick);
}

void register_all(const BenchOptions& options) {
  register_handoffs_of<devices::GloveState>("glove-state", options.quick);
  register_handoffs_of<devices::HapticState>("haptic-state", options.quick);
  register_handoffs_of<haptics::ContactSet>("contact-set", options.quick);
}

}  // namespace
}  // namespace glissade::bench

int main(int argc, char** argv) {
  return glissade::bench::run_bench_program(argc, argv,
                                            "Measure the passing of values between two threads: a triple buffer and a "
                                            "ring of Glissade, a value under a\nmutex, boost::lockfree::spsc_queue",
                                            glissade::bench::register_all);
}
