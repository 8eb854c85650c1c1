#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

#include <unistd.h>

#include <glissade/apps/latency/helper_process.h>
#include <glissade/apps/latency/latency_glove.h>
#include <glissade/apps/latency/latency_rules.h>
#include <glissade/apps/latency/latency_run.h>
#include <glissade/apps/latency/machine_load.h>
#include <glissade/apps/latency/shared_stamps.h>
#include <glissade/apps/latency/udp_ping_pong.h>
#include <glissade/apps/run/lcm_option.h>
#include <glissade/contact/contact_body.h>
#include <glissade/devices/haptic_state.h>
#include <glissade/devices/lcm_glove.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/grasping/grasp_simulation.h>
#include <glissade/haptics/haptic_server.h>
#include <glissade/realtime/clock.h>
#include <glissade/realtime/periodic_thread.h>

namespace glissade::apps {

namespace {

using std::chrono::milliseconds;

constexpr std::string_view kInProcess = "in process";
constexpr std::string_view kMemq = "memq://";
constexpr std::string_view kUdpm = "udpm://";

/// The work of the second process.
constexpr char kGlove = 'g';
constexpr char kPongs = 'p';

constexpr milliseconds kLook{20};  // between two looks at what goes on
constexpr milliseconds kLongestSlice{1000};
constexpr milliseconds kPatience{10'000};  // with a slice that does not end
constexpr int kSlicesOfARound = 8;         // three links and the ping-pong, idle and loaded

/// Ports that no other measurement on this machine uses at the same time, and no glove by default.
std::uint16_t first_port() {
  return static_cast<std::uint16_t>(20'000 + 3 * (getpid() % 4000));
}

PingPongAddress ping_pong_address() {
  return {static_cast<std::uint16_t>(first_port() + 1), static_cast<std::uint16_t>(first_port() + 2)};
}

std::string udpm_url() {
  return "udpm://" + std::string(kPingPongGroup) + ":" + std::to_string(first_port()) + "?ttl=0";
}

std::shared_ptr<const geometry::TriangleMesh> plate() {
  return std::make_shared<geometry::TriangleMesh>(geometry::make_plate({0.4, 0.4}, 200));
}

std::shared_ptr<const geometry::TriangleMesh> box() {
  return std::make_shared<geometry::TriangleMesh>(geometry::make_box({0.1, 0.06, 0.04}, 1200));
}

/// 2 mm above the plate.
Eigen::Isometry3d start_of_box() {
  return Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, 0.022));
}

grasping::GraspSimulation make_simulation() {
  const auto plate_W = std::make_shared<contact::ContactBody>(plate());
  const auto box_V = std::make_shared<contact::SlidingPart>(box());
  return {{{plate_W}}, {{.part_V = box_V, .X_WV_start = start_of_box()}}, {}, {.sliding = contact::real_time_rules()}};
}

/// Measures slice by slice.
class LatencyRun {
 public:
  LatencyRun(milliseconds slice, const std::function<void(milliseconds)>& watch)
      : slice_(slice),
        watch_(watch),
        received_(kept_sequences()),
        arrivals_(kept_sequences()),
        address_(ping_pong_address()),
        url_(udpm_url()),
        helper_([this](char work, const std::atomic<bool>& should_end) { help(work, should_end); }) {}

  /// One slice of each link, and one of the ping-pong.
  void measure(LoadFigures& figures) {
    for (LinkFigures& link : figures.links) {
      received_.clear();
      arrivals_.clear();
      if (link.link == kInProcess) measure_in_process(link);
      if (link.link == kMemq) measure_over(std::make_shared<devices::LcmBus>("memq://"), link);
      if (link.link == kUdpm) measure_over(connect_to_lcm(url_), link);
    }
    measure_round_trip(figures.round_trip);
  }

  bool has_fifo_scheduling() const { return has_fifo_scheduling_; }
  /// The ticks of the first slice in process.
  std::shared_ptr<const SessionRecorder> first_slice() const { return first_slice_; }

 private:
  std::int64_t ticks() const { return slice_ / kLatencyTick; }
  /// Of a slice, with the ticks of the fade and the states from before the first tick.
  std::size_t kept_sequences() const { return static_cast<std::size_t>(ticks()) + 20'000; }

  /// In the second process.
  void help(char work, const std::atomic<bool>& should_end) {
    if (work == kPongs) {
      send_pongs(address_, should_end);
      return;
    }
    const LinkedGlove glove(std::make_shared<devices::LcmBus>(url_), arrivals_);
    while (!should_end.load())
      std::this_thread::sleep_for(kLook);
  }

  void measure_in_process(LinkFigures& figures) {
    DirectGlove direct(received_, arrivals_);
    StampedGlove glove(direct, kept_sequences());
    if (first_slice_) {
      run_loop(
          glove, [](const devices::HapticState&) {}, figures);
    } else {
      first_slice_ = std::make_shared<SessionRecorder>(static_cast<std::size_t>(ticks()), 1, 1);
      run_loop(
          glove, [&](const devices::HapticState& state) { first_slice_->record(state); }, figures);
    }
    glove.add_ways(received_, arrivals_, figures.stages);
  }

  /// The glove at the other end is in this process over memq, in the second one over udpm.
  void measure_over(const std::shared_ptr<devices::LcmBus>& bus, LinkFigures& figures) {
    const bool is_far = figures.link == kUdpm;
    if (is_far) helper_.begin(kGlove);
    {
      std::optional<LinkedGlove> near;
      if (!is_far) near.emplace(bus, arrivals_);
      devices::LcmGlove link(bus, devices::simulated_glove_descriptor());
      const auto subscription = note_states(*bus, received_);
      devices::HapticStatePublisher publisher(bus);
      StampedGlove glove(link, kept_sequences());
      run_loop(
          glove, [&](const devices::HapticState& sample) { publisher.push(sample); }, figures);
      std::this_thread::sleep_for(kLook);  // the last commands are on their way
      glove.add_ways(received_, arrivals_, figures.stages);
    }
    if (is_far) helper_.end();
  }

  void run_loop(StampedGlove& glove, const std::function<void(const devices::HapticState&)>& sink,
                LinkFigures& figures) {
    grasping::GraspSimulation simulation = make_simulation();
    haptics::HapticServer server({{&glove}}, simulation, {.period = kLatencyTick, .ticks = ticks(), .sink = sink});
    realtime::PeriodicThread bare_loop(clock_, {.period = kLatencyTick, .fifo_priority = realtime::kHapticPriority},
                                       [](const realtime::PeriodicTick&) { return true; });
    const std::chrono::nanoseconds give_up = clock_.now() + slice_ + kPatience;
    while (!server.is_done() && !server.has_failed() && clock_.now() < give_up) {
      std::this_thread::sleep_for(kLook);
      watch_(measured_ + std::chrono::duration_cast<milliseconds>(server.ticks() * kLatencyTick));
    }
    bare_loop.stop();
    server.stop();
    if (server.has_failed()) throw std::runtime_error("the simulation failed: " + server.failure());
    if (!server.is_done()) throw std::runtime_error(std::string(figures.link) + ": the glove is not heard");
    measured_ += slice_;
    has_fifo_scheduling_ = server.statistics().scheduling.is_fifo;
    figures.haptic_lateness.add(server.statistics().haptic.lateness);
    figures.bare_lateness.add(bare_loop.statistics().lateness);
  }

  void measure_round_trip(realtime::LatencyHistogram& round_trip) {
    helper_.begin(kPongs);
    const std::chrono::nanoseconds end = clock_.now() + slice_;
    send_pings(
        address_, [&] { return clock_.now() < end; }, round_trip);
    helper_.end();
    measured_ += slice_;
    watch_(measured_);
  }

  milliseconds slice_;
  std::function<void(milliseconds)> watch_;
  milliseconds measured_{0};
  bool has_fifo_scheduling_ = false;
  std::shared_ptr<SessionRecorder> first_slice_;
  realtime::SteadyClock clock_;
  SharedStamps received_;
  SharedStamps arrivals_;
  PingPongAddress address_;
  std::string url_;  // as in the second process, whose number is another
  HelperProcess helper_;
};

double ratio(std::chrono::nanoseconds dividend, std::chrono::nanoseconds divisor) {
  return static_cast<double>(dividend.count()) / static_cast<double>(std::max<std::int64_t>(1, divisor.count()));
}

}  // namespace

viewer::ViewScene latency_view() {
  viewer::ViewScene view{.title = "glissade latency", .objects = {{"plate", plate()}}, .hands = {{"glove"}}};
  view.objects.push_back({"box", box(), start_of_box(), 0});
  return view;
}

LatencyRatios latency_ratios(const LoadFigures& figures) {
  realtime::LatencyHistogram haptic;
  realtime::LatencyHistogram bare;
  LatencyRatios ratios;
  for (const LinkFigures& link : figures.links) {
    haptic.add(link.haptic_lateness);
    bare.add(link.bare_lateness);
    if (link.link != kUdpm) continue;
    ratios.udpm_p50 = ratio(link.stages.whole.quantile(0.5), figures.round_trip.quantile(0.5) + kLatencyTick / 2);
  }
  ratios.lateness_p50 = ratio(haptic.quantile(0.5), bare.quantile(0.5));
  ratios.lateness_p99 = ratio(haptic.quantile(0.99), bare.quantile(0.99));
  return ratios;
}

LatencyFigures measure_latency(milliseconds duration, const std::function<void(milliseconds)>& watch) {
  LatencyFigures figures;
  for (LoadFigures* load : {&figures.idle, &figures.loaded})
    load->links = {{.link = kInProcess}, {.link = kMemq}, {.link = kUdpm}};
  const std::int64_t rounds = std::max<std::int64_t>(1, duration / (kSlicesOfARound * kLongestSlice));
  LatencyRun run(duration / (kSlicesOfARound * rounds), watch);
  for (std::int64_t round = 0; round < rounds; ++round) {
    run.measure(figures.idle);
    const MachineLoad load;
    run.measure(figures.loaded);
  }
  figures.has_fifo_scheduling = run.has_fifo_scheduling();
  figures.slice = run.first_slice();
  return figures;
}

}  // namespace glissade::apps
