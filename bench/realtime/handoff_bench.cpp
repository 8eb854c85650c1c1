/// The passing of a value between two threads: this library's buffers beside a
/// mutex and Boost's queue.

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>

#include <glissade/devices/glove_device.h>
#include <glissade/devices/haptic_state.h>
#include <glissade/haptics/contact_set.h>
#include <glissade/realtime/latency_histogram.h>

#include "handoffs.h"
#include "results.h"

namespace glissade::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kHandoff = "handoff";
constexpr const char* kOneThread = "-one-thread";
constexpr const char* kTwoThreads = "-two-threads";

/// What the library passes on, with the moment at which it was published.
template <typename Payload>
struct Stamped {
  Clock::time_point published;
  Payload payload;
};

/// What one way takes: the figures of each slice, ns.
struct HandoffTimes {
  std::vector<double> one_thread;   ///< mean of a publish and a take in the same thread
  std::vector<double> publish_p50;  ///< while the other thread looks for the value all the time
  std::vector<double> publish_p99;
  std::vector<double> handoff_p50;  ///< from before the publish until the other
                                    ///< thread has taken the value
  std::vector<double> handoff_p99;
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double quantile_ns(const realtime::LatencyHistogram& histogram, double p) {
  return static_cast<double>(histogram.quantile(p).count());
}

/// The mean time of a publish and a take in one thread, ns.
template <typename Handoff, typename Value>
double one_thread_ns(Handoff& handoff, Value& value, int calls) {
  for (int i = 0; i < calls / 10; ++i) {  // warms the caches
    handoff.publish(value);
    handoff.take(value);
  }
  const Clock::time_point start = Clock::now();
  for (int i = 0; i < calls; ++i) {
    handoff.publish(value);
    handoff.take(value);
  }
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count() / calls;
}

/// Waits for `condition` on a processor. Where the two threads of the bench share one, the other gets its turn.
template <typename Condition>
void spin_until(const Condition& condition) {
  constexpr int kPatience = 2000;
  for (int i = 1; !condition(); ++i) {
    if (i % kPatience == 0) std::this_thread::yield();
  }
}

/// One thread publishes when the other has taken the last value, which it looks for without a pause.
template <typename Handoff, typename Value>
void two_threads(Handoff& handoff, const Value& value, int handoffs, HandoffTimes& times) {
  realtime::LatencyHistogram publish;
  realtime::LatencyHistogram handoff_time;
  std::atomic<int> taken{0};
  std::thread reader([&] {
    const auto read = std::make_unique<Value>(value);
    for (int i = 1; i <= handoffs; ++i) {
      spin_until([&] { return handoff.take(*read); });
      handoff_time.record(Clock::now() - read->published);
      taken.store(i, std::memory_order_release);
    }
  });
  const auto written = std::make_unique<Value>(value);
  for (int i = 1; i <= handoffs; ++i) {
    written->published = Clock::now();
    handoff.publish(*written);
    publish.record(Clock::now() - written->published);
    spin_until([&] { return taken.load(std::memory_order_acquire) >= i; });
  }
  reader.join();
  times.publish_p50.push_back(quantile_ns(publish, 0.5));
  times.publish_p99.push_back(quantile_ns(publish, 0.99));
  times.handoff_p50.push_back(quantile_ns(handoff_time, 0.5));
  times.handoff_p99.push_back(quantile_ns(handoff_time, 0.99));
}

/// A slice of each way; they take turns.
template <typename Value, template <typename> typename... Handoffs>
void measure(const std::string& name, bool quick, Results& results) {
  constexpr std::array kSubjects{Handoffs<Value>::kSubject...};
  const int slices = quick ? 5 : 51;
  const int calls = sizeof(Value) > 4096 ? 500 : 5000;
  const auto value = std::make_unique<Value>();
  std::fprintf(stderr, "handoff %s, %zu bytes\n", name.c_str(), sizeof(Value));
  std::vector<HandoffTimes> times(kSubjects.size());
  for (int slice = 0; slice < slices; ++slice) {
    auto next = times.begin();
    const auto one_slice = [&](auto handoff) {
      next->one_thread.push_back(one_thread_ns(*handoff, *value, calls));
      two_threads(*handoff, *value, calls, *next++);
    };
    (one_slice(std::make_unique<Handoffs<Value>>()), ...);
  }
  for (std::size_t i = 0; i < kSubjects.size(); ++i) {
    const auto add = [&](const std::string& threads, const std::string& metric, const std::vector<double>& of_slices) {
      results.add({kHandoff, name + threads, kSubjects[i], metric, median(of_slices), "ns"});
    };
    add(kOneThread, "time", times[i].one_thread);
    add(kTwoThreads, "time", times[i].handoff_p50);
    add(kTwoThreads, "time_p99", times[i].handoff_p99);
    add(kTwoThreads, "publish_p50", times[i].publish_p50);
    add(kTwoThreads, "publish_p99", times[i].publish_p99);
  }
  results.add({kHandoff, name, "value", "size", static_cast<double>(sizeof(Value)), "B"});
}

template <typename Payload>
void measure_all(const std::string& name, bool quick, Results& results) {
  measure<Stamped<Payload>, TripleBufferHandoff, RingHandoff, MutexHandoff, BoostHandoff>(name, quick, results);
}

int parse_and_run(int argc, char** argv) {
  bool quick = false;
  std::filesystem::path folder = ".";
  CLI::App app{
      "Measure the passing of values between two threads: a triple "
      "buffer and a ring of Glissade, a value under a\n"
      "mutex, boost::lockfree::spsc_queue. Figures go to results.csv: "
      "bench,case,subject,metric,value,unit.",
      "handoff_bench"};
  app.footer(
      "Example:\n  handoff_bench --quick --out /tmp\nscripts/bench "
      "--only handoff renews docs/benchmarks.md.");
  app.add_flag("--quick", quick, "Fewer slices: within seconds");
  app.add_option("--out", folder, "Folder for results.csv, created if necessary")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  std::filesystem::create_directories(folder);
  Results results;
  measure_all<devices::GloveState>("glove-state", quick, results);
  measure_all<devices::HapticState>("haptic-state", quick, results);
  measure_all<haptics::ContactSet>("contact-set", quick, results);
  const std::vector<std::string> peers{"mutex", "boost-spsc"};
  results.add_ratios(kHandoff, peers);
  results.add_group_ratios(kHandoff, "one-thread", {kOneThread}, peers);
  results.add_group_ratios(kHandoff, "two-threads", {kTwoThreads}, peers);
  results.write_csv(folder / "results.csv");
  return 0;
}

}  // namespace
}  // namespace glissade::bench

int main(int argc, char** argv) {
  try {
    return glissade::bench::parse_and_run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "handoff_bench: %s\n", error.what());
    return 1;
  }
}
