// Runs the haptic server with two hands and three parts, as `glissade run` does, and watches the haptic thread from its
// first counted tick to its end. One of the hands has a device that holds half-spaces. The thread allocates and
// releases no memory, and calls no function that could wait for another thread. The timer's are its only system calls.
// It waits for no page, which is judged only where the system grants locked memory.
//
// The loop runs at 5 kHz, so that 60,000 ticks take 12 seconds. Nothing is judged by the clock.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <unistd.h>

#include <glissade/apps/run/run_watch.h>
#include <glissade/apps/run/session_sink.h>
#include <glissade/devices/simulated_glove_service.h>
#include <glissade/haptics/haptic_server.h>
#include <glissade/haptics/recording.h>
#include <glissade/realtime/periodic_thread.h>
#include <glissade/viewer/view_server.h>

#include "allocation_counter.h"
#include "lock_counter.h"
#include "proof_scene.h"
#include "system_call_watch.h"

namespace glissade::test_support {
namespace {

constexpr std::size_t kHands = 2;
constexpr std::size_t kParts = 3;
constexpr std::chrono::microseconds kPeriod(200);

/// Does in a tick what no tick may do, if it is told to.
class Offender {
 public:
  explicit Offender(const std::string& deed) : deed_(deed), nowhere_(open("/dev/null", O_WRONLY | O_CLOEXEC)) {
    if (nowhere_ < 0) throw std::runtime_error("/dev/null cannot be opened");
  }
  ~Offender() { close(nowhere_); }
  Offender(const Offender&) = delete;
  Offender& operator=(const Offender&) = delete;

  void act() {
    if (deed_ == "new") memory_ = std::make_unique<int>(1);
    if (deed_ == "lock") const std::lock_guard lock(mutex_);
    if (deed_ == "write" && write(nowhere_, "", 1) != 1) throw std::runtime_error("/dev/null is full");
  }

 private:
  std::string deed_;
  int nowhere_;
  std::unique_ptr<int> memory_;
  std::mutex mutex_;
};

/// What a thread has done so far.
struct Deeds {
  std::int64_t allocations = 0;
  std::int64_t releases = 0;
  std::int64_t locks = 0;
};

Deeds deeds_of_this_thread() noexcept {
  return {allocations_of_this_thread(), releases_of_this_thread(), locks_of_this_thread()};
}

/// The receiver of the states, with all that the program does with them, and the observer of the haptic thread.
class Witness {
 public:
  Witness(const std::shared_ptr<devices::LcmBus>& bus, std::int64_t ticks, const std::string& deed)
      : recorder_(std::make_shared<apps::SessionRecorder>(static_cast<std::size_t>(ticks), kParts, kHands)),
        sink_(bus, recorder_, run_watch_, &view_),
        offender_(deed) {}

  /// In each counted tick, in the haptic thread.
  void see(const devices::HapticState& sample) {
    constexpr std::int64_t kFirstOffence = 1000;
    if (sample.sequence == 1) begin();
    sink_.receive(sample);
    if (sample.sequence >= kFirstOffence) offender_.act();
  }

  /// After the last command of each tick, counted or not, in the haptic thread.
  void note_command() noexcept {
    commands_.fetch_add(1);
    newest_ = deeds_of_this_thread();
    last_lock_ = last_lock_of_this_thread();
  }

  double greatest_force_N(std::size_t hand) const {
    double greatest = 0.0;
    for (std::size_t i = 0; i < recorder_->size(); ++i)
      greatest = std::max(greatest, recorder_->hand(i, hand).force_W.norm());
    return greatest;
  }

  /// After the haptic thread has ended: what it did that it must not do, in sentences.
  std::vector<std::string> charges() {
    std::vector<std::string> result;
    const auto charge = [&](std::int64_t times, const std::string& what) {
      if (times > 0) result.push_back("the haptic thread " + what + " " + std::to_string(times) + " times");
    };
    if (!is_watched_) result.emplace_back("the system does not let a thread's system calls be watched");
    charge(newest_.allocations - first_.allocations, "allocated memory");
    charge(newest_.releases - first_.releases, "released memory");
    charge(newest_.locks - first_.locks, std::string("called ") + last_lock_ + " and other locks");
    // After its last command the thread only ends.
    for (const SystemCall& call : watch_.finish()) {
      if (call.at == commands_) continue;
      result.push_back("the haptic thread made the system call " + name_of(call) + " in tick " +
                       std::to_string(call.at + 1) + ", and perhaps others after it");
      break;
    }
    return result;
  }

 private:
  void begin() noexcept {
    is_watched_ = watch_.begin_in_this_thread();
    first_ = deeds_of_this_thread();
  }

  std::atomic<std::int64_t> commands_{0};
  SystemCallWatch watch_{commands_};
  bool is_watched_ = false;
  Deeds first_;
  Deeds newest_;
  const char* last_lock_ = "none";
  std::shared_ptr<apps::SessionRecorder> recorder_;
  viewer::ViewServer view_{viewer::ViewScene{}};  // which browsers could ask
  apps::RunWatch run_watch_{{"first", "second", "third"}, {{1, 0}, {2, 1}}, 0.0};
  apps::SessionSink sink_;
  Offender offender_;
};

/// The loop, until it has made its ticks. Meanwhile hands let go and take hold again.
haptics::HapticServerStatistics run_server(Witness& witness, const std::shared_ptr<devices::LcmBus>& bus,
                                           std::int64_t ticks) {
  constexpr std::chrono::seconds kLonger(600);
  realtime::SteadyClock clock;
  grasping::GraspSimulation parts = proof_parts();
  devices::SimulatedGloveService remote(bus, proof_hand(kLonger), clock);
  devices::LcmGlove link(bus, devices::simulated_glove_descriptor());
  ProofGlove device(proof_arm(kLonger), kPeriod, [&witness] { witness.note_command(); });
  haptics::FlightRecorder flight({});
  haptics::BackgroundObserver recorders({&flight});
  haptics::HapticServer server({{&link, 0}, {&device, 1}}, parts,
                               {.period = kPeriod,
                                .ticks = ticks,
                                .sink = [&witness](const devices::HapticState& sample) { witness.see(sample); },
                                .observer = &recorders});
  for (int i = 0; !server.is_done() && !server.has_failed(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    if (i % 20 == 10) server.release(1);
    if (i % 20 == 15) server.grasp(1, 1);
  }
  server.stop();
  if (server.has_failed()) throw std::runtime_error("the server failed: " + server.failure());
  if (link.statistics().accepted == 0) throw std::runtime_error("the glove behind the link was not heard");
  return server.statistics();
}

void print(const haptics::HapticServerStatistics& statistics, const Witness& witness, std::int64_t ticks) {
  const auto us = [](std::chrono::nanoseconds time) { return 1e-3 * static_cast<double>(time.count()); };
  const auto row = [&](const char* name, const realtime::LatencyHistogram& histogram) {
    std::cout << "  " << name << " p50 / p99 / max: " << us(histogram.quantile(0.5)) << " / "
              << us(histogram.quantile(0.99)) << " / " << us(histogram.max()) << " us\n";
  };
  std::cout << ticks << " ticks of two hands and three parts, one each " << us(kPeriod) << " us\n";
  row("tick", statistics.haptic.duration);
  row("lateness", statistics.haptic.lateness);
  row("simulation", statistics.simulation);
  std::cout << "  greatest forces: " << witness.greatest_force_N(0) << " and " << witness.greatest_force_N(1) << " N\n"
            << "  scheduling: " << (statistics.scheduling.is_fifo ? "SCHED_FIFO" : "ordinary") << '\n'
            << "  page faults: " << statistics.page_faults
            << (statistics.scheduling.has_locked_memory ? "" : ", not judged: memory cannot be locked") << '\n';
}

/// Returns whether the haptic thread did nothing wrong.
bool prove(std::int64_t ticks, const std::string& deed) {
  realtime::lock_memory();
  const auto bus = std::make_shared<devices::LcmBus>("memq://");
  Witness witness(bus, ticks, deed);
  const haptics::HapticServerStatistics statistics = run_server(witness, bus, ticks);
  print(statistics, witness, ticks);
  std::vector<std::string> charges = witness.charges();
  if (statistics.scheduling.has_locked_memory && statistics.page_faults > 0) {
    charges.push_back("the haptic thread waited for " + std::to_string(statistics.page_faults) + " pages");
  }
  if (witness.greatest_force_N(0) < 0.5 || witness.greatest_force_N(1) < 0.5) {
    charges.emplace_back("a hand felt no contact, so little is proved");
  }
  for (const std::string& charge : charges)
    std::cout << "failed: " << charge << '\n';
  if (charges.empty()) std::cout << "no allocation, no lock, no system call but the timer's\n";
  return charges.empty();
}

}  // namespace
}  // namespace glissade::test_support

int main(int argc, char** argv) {
  CLI::App app("Watches what the haptic thread does");
  std::int64_t ticks = 60'000;
  std::string deed;
  app.add_option("--ticks", ticks, "Number of ticks")->check(CLI::Range(1, 10'000'000))->capture_default_str();
  app.add_option("--put-in", deed, "What to do in each tick from the thousandth on, which must be found")
      ->check(CLI::IsMember({"new", "lock", "write"}));
  CLI11_PARSE(app, argc, argv);
  try {
    return glissade::test_support::prove(ticks, deed) ? 0 : 1;
  } catch (const std::exception& error) {
    std::cout << "failed: " << error.what() << '\n';
    return 1;
  }
}
