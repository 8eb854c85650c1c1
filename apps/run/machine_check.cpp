#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <optional>
#include <sstream>
#include <thread>

#include <sys/prctl.h>
#include <sys/resource.h>

#include <glissade/apps/run/machine_check.h>
#include <glissade/apps/text.h>
#include <glissade/realtime/clock.h>
#include <glissade/realtime/periodic_thread.h>

namespace glissade::apps {

namespace {

constexpr std::array<std::string_view, 4> kVerdictNames{"good", "can be better", "bad", "unknown"};

constexpr const char* kNoFifo =
    "any busy program can hold up the haptic thread, states of gloves and contacts for milliseconds";
constexpr const char* kNoLockedMemory = "a page that the system has moved out costs a tick milliseconds";
constexpr const char* kMendRights =
    "printf '%s - rtprio 90\\n%s - memlock unlimited\\n' \"$USER\" \"$USER\" | sudo tee "
    "/etc/security/limits.d/90-haptics.conf  # and log in again";

/// The first line of a file; nothing if it cannot be read.
std::optional<std::string> line_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  if (!std::getline(stream, line)) return std::nullopt;
  return line;
}

Finding unknown(std::string name, std::string meaning) {
  return {std::move(name), Verdict::kUnknown, "not told by this machine", std::move(meaning), ""};
}

Finding fifo() {
  realtime::SteadyClock clock;
  realtime::PeriodicThread probe(clock, {.fifo_priority = realtime::kHapticPriority},
                                 [](const realtime::PeriodicTick&) { return false; });
  probe.join();
  if (probe.scheduling().is_fifo) {
    return {"SCHED_FIFO", Verdict::kGood, "granted",
            "the threads between a glove and its forces run ahead of every ordinary thread", ""};
  }
  return {"SCHED_FIFO", Verdict::kCanBeBetter, "refused", kNoFifo, kMendRights};
}

Finding locked_memory() {
  if (realtime::may_lock_memory()) {
    return {"locked memory", Verdict::kGood, "granted", "no tick waits for a page that the system has moved out", ""};
  }
  rlimit limit{};
  getrlimit(RLIMIT_MEMLOCK, &limit);
  return {"locked memory", Verdict::kCanBeBetter, "at most " + std::to_string(limit.rlim_cur >> 10) + " KiB",
          kNoLockedMemory, kMendRights};
}

Finding timer_slack() {
  const int before = prctl(PR_GET_TIMERSLACK, 0UL, 0UL, 0UL, 0UL);
  return {"timer slack", Verdict::kGood, std::to_string(before) + " ns by default",
          "the loop's threads set it to 1 ns themselves, so that sleeps end in time", ""};
}

Finding throttle(const std::filesystem::path& root) {
  constexpr const char* kMeaning =
      "the kernel takes the processor from a FIFO thread that never sleeps; the loop sleeps in every tick";
  const auto runtime = line_of(root / "proc/sys/kernel/sched_rt_runtime_us");
  const auto period = line_of(root / "proc/sys/kernel/sched_rt_period_us");
  if (!runtime || !period) return unknown("real-time throttle", kMeaning);
  const auto share = parse_number(*runtime);
  const bool is_usual = share && (*share < 0.0 || *share >= 900'000.0);
  return {"real-time throttle", is_usual ? Verdict::kGood : Verdict::kBad, *runtime + " of " + *period + " us",
          kMeaning, is_usual ? "" : "sudo sysctl kernel.sched_rt_runtime_us=950000"};
}

Finding governor(const std::filesystem::path& root) {
  constexpr const char* kMeaning = "a processor that slows down between ticks needs longer for the next one";
  const auto value = line_of(root / "sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
  if (!value) return unknown("frequency governor", kMeaning);
  const bool is_fast = *value == "performance";
  return {"frequency governor", is_fast ? Verdict::kGood : Verdict::kCanBeBetter, *value, kMeaning,
          is_fast ? "" : "sudo cpupower frequency-set -g performance"};
}

Finding idle_states(const std::filesystem::path& root) {
  constexpr const char* kMeaning = "a processor wakes up from a deep idle state only after this time";
  constexpr double kShort_us = 20.0;
  double longest_us = -1.0;
  for (int i = 0;; ++i) {
    const auto state = root / "sys/devices/system/cpu/cpu0/cpuidle" / ("state" + std::to_string(i));
    const auto latency = line_of(state / "latency");
    if (!latency) break;
    if (line_of(state / "disable").value_or("0") == "0") {
      longest_us = std::max(longest_us, parse_number(*latency).value_or(0.0));
    }
  }
  if (longest_us < 0.0) return unknown("idle states", kMeaning);
  const bool is_short = longest_us <= kShort_us;
  return {"idle states", is_short ? Verdict::kGood : Verdict::kCanBeBetter,
          "up to " + format_number(longest_us) + " us", kMeaning, is_short ? "" : "sudo cpupower idle-set -D 20"};
}

Finding kernel(const std::filesystem::path& root) {
  const bool is_realtime = line_of(root / "sys/kernel/realtime").value_or("0") == "1";
  const std::string release = line_of(root / "proc/sys/kernel/osrelease").value_or("unknown");
  if (is_realtime) {
    return {"kernel", Verdict::kGood, release + ", PREEMPT_RT", "the kernel itself lets the haptic thread in at once",
            ""};
  }
  return {"kernel", Verdict::kCanBeBetter, release + ", without PREEMPT_RT",
          "the kernel itself may hold the haptic thread up, rarely for longer than a millisecond",
          "sudo apt-get install linux-image-rt-amd64  # and start it"};
}

Finding clock_source(const std::filesystem::path& root) {
  constexpr const char* kMeaning = "every tick reads the clock; only some sources can be read without a system call";
  const auto value = line_of(root / "sys/devices/system/clocksource/clocksource0/current_clocksource");
  if (!value) return unknown("clock source", kMeaning);
  const bool is_fast = *value == "tsc" || *value == "kvm-clock" || *value == "arch_sys_counter" ||
                       *value == "hyperv_clocksource_tsc_page";
  return {"clock source", is_fast ? Verdict::kGood : Verdict::kCanBeBetter, *value, kMeaning,
          is_fast ? "" : "echo tsc | sudo tee /sys/devices/system/clocksource/clocksource0/current_clocksource"};
}

Finding processors() {
  constexpr unsigned kEnough = 4;
  const unsigned count = std::thread::hardware_concurrency();
  return {"processors", count >= kEnough ? Verdict::kGood : Verdict::kCanBeBetter, std::to_string(count),
          "haptic loop, simulation, search and the rest of the system work at the same time", ""};
}

Finding virtual_machine(const std::filesystem::path& root) {
  std::ifstream stream(root / "proc/cpuinfo");
  if (!stream) return unknown("virtual machine", "a host may take the processor away without a word");
  std::ostringstream text;
  text << stream.rdbuf();
  const bool is_virtual = text.str().find(" hypervisor") != std::string::npos;
  return {"virtual machine", is_virtual ? Verdict::kCanBeBetter : Verdict::kGood, is_virtual ? "yes" : "no",
          is_virtual ? "the host may take the processor away for milliseconds without a word"
                     : "nobody takes the processor away",
          ""};
}

/// A route whose destination and mask have the group 239.255.76.67.
bool has_multicast_route(const std::filesystem::path& root) {
  std::ifstream stream(root / "proc/net/route");
  constexpr std::uint32_t kGroup = 0x434CFFEF;  // as the file has it, in the order of the network
  std::string line;
  std::getline(stream, line);
  while (std::getline(stream, line)) {
    std::istringstream fields(line);
    std::array<std::string, 8> field;
    for (std::string& text : field)
      fields >> text;
    const auto number = [](const std::string& text) {
      std::uint32_t value = 0;
      std::from_chars(text.data(), text.data() + text.size(), value, 16);
      return value;
    };
    if (field[7].empty()) continue;
    if ((kGroup & number(field[7])) == number(field[1])) return true;
  }
  return false;
}

Finding multicast(const std::filesystem::path& root) {
  const bool has_route = has_multicast_route(root);
  return {"multicast route", has_route ? Verdict::kGood : Verdict::kBad, has_route ? "there is one" : "there is none",
          "glove and server in two processes find each other at udpm://239.255.76.67:7667",
          has_route ? "" : kMulticastMend};
}

}  // namespace

std::string_view name_of(Verdict verdict) {
  return kVerdictNames[static_cast<std::size_t>(verdict)];
}

std::vector<Finding> check_machine(const std::filesystem::path& root) {
  return {fifo(),       locked_memory(),    timer_slack(), throttle(root),        governor(root), idle_states(root),
          kernel(root), clock_source(root), processors(),  virtual_machine(root), multicast(root)};
}

std::string missing_rights(bool has_fifo, bool has_locked_memory) {
  if (has_fifo && has_locked_memory) return {};
  std::string text;
  if (!has_fifo) text += std::string("SCHED_FIFO is not granted: ") + kNoFifo + "; ";
  if (!has_locked_memory) text += std::string("memory is not locked: ") + kNoLockedMemory + "; ";
  return text + "this mends it: " + kMendRights;
}

}  // namespace glissade::apps
