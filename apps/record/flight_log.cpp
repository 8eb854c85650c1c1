#include <algorithm>
#include <exception>
#include <filesystem>
#include <system_error>
#include <utility>

#include <glissade/apps/record/flight_log.h>

namespace glissade::apps {

namespace {

bool is_fault(const devices::LimitReasons& reasons) {
  return reasons.not_finite || reasons.is_implausible || reasons.is_state_old || reasons.is_command_old;
}

bool has_fault(const devices::HapticState& state) {
  const auto end = state.hands.begin() + state.hand_count;
  return std::any_of(state.hands.begin(), end,
                     [](const devices::HapticHandState& hand) { return is_fault(hand.reasons); });
}

}  // namespace

void FlightLog::after_tick(const haptics::TickRecord& record) noexcept {
  constexpr std::chrono::milliseconds kAftermath(500);
  recorder_.after_tick(record);
  const bool is_at_fault = record.sequence > 0 && has_fault(record.state);
  if (is_at_fault && !was_at_fault_ && !is_pending_) {
    is_pending_ = true;
    fault_at_ = record.time;
  }
  was_at_fault_ = is_at_fault;
  const bool has_ended = record.sequence == 0;
  if (!is_pending_ || (!has_ended && record.time - fault_at_ < kAftermath)) return;
  is_pending_ = false;
  is_due_.store(true, std::memory_order_relaxed);
}

std::string FlightLog::write(bool is_last) {
  is_due_.store(false, std::memory_order_relaxed);
  if (files_ == kMostFiles && !is_last) {
    return "the flight recorder has written " + std::to_string(kMostFiles) + " files and writes no more";
  }
  ++files_;
  const std::filesystem::path first(path_);
  std::filesystem::path path = first;
  std::error_code ignored;
  for (int number = 2; std::filesystem::exists(std::filesystem::symlink_status(path, ignored)); ++number) {
    path = first;
    path.replace_extension();
    path += "-" + std::to_string(number);
    path += first.extension();
  }
  try {
    recorder_.write(path.string());
  } catch (const std::exception& error) {
    return std::string("the flight recorder: ") + error.what();
  }
  return "the last seconds are in " + path.string();
}

}  // namespace glissade::apps
