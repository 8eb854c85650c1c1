#include "system_call_watch.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <utility>

#include <linux/filter.h>
#include <linux/seccomp.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace glissade::test_support {

namespace {

/// What a loop on a timer needs. The clock is read without a system call where the machine allows that.
constexpr std::array kAllowed{SYS_clock_nanosleep, SYS_clock_gettime, SYS_restart_syscall, SYS_rt_sigreturn};

/// A program for the kernel: allowed calls go on, all others are told to the listener.
auto make_filter() noexcept {
  std::array<sock_filter, kAllowed.size() + 3> filter{};
  filter[0] = BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr));
  for (std::size_t i = 0; i < kAllowed.size(); ++i) {
    const auto to_the_end = static_cast<std::uint8_t>(kAllowed.size() - i);
    filter[i + 1] = BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(kAllowed[i]), to_the_end, 0);
  }
  filter[kAllowed.size() + 1] = BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_USER_NOTIF);
  filter[kAllowed.size() + 2] = BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
  return filter;
}

}  // namespace

std::string name_of(const SystemCall& call) {
  constexpr std::array kNames{std::pair(SYS_write, "write"),
                              std::pair(SYS_read, "read"),
                              std::pair(SYS_futex, "futex"),
                              std::pair(SYS_mmap, "mmap"),
                              std::pair(SYS_munmap, "munmap"),
                              std::pair(SYS_mprotect, "mprotect"),
                              std::pair(SYS_madvise, "madvise"),
                              std::pair(SYS_brk, "brk"),
                              std::pair(SYS_sched_yield, "sched_yield"),
                              std::pair(SYS_sendto, "sendto"),
                              std::pair(SYS_sendmsg, "sendmsg"),
                              std::pair(SYS_recvfrom, "recvfrom"),
                              std::pair(SYS_ioctl, "ioctl"),
                              std::pair(SYS_getrusage, "getrusage")};
  const auto found =
      std::find_if(kNames.begin(), kNames.end(), [&](const auto& entry) { return entry.first == call.number; });
  return found == kNames.end() ? "number " + std::to_string(call.number) : found->second;
}

SystemCallWatch::SystemCallWatch(const std::atomic<std::int64_t>& counter)
    : counter_(counter), recorder_([this] { record_calls(); }) {}

SystemCallWatch::~SystemCallWatch() {
  finish();
}

bool SystemCallWatch::begin_in_this_thread() noexcept {
  auto filter = make_filter();
  const sock_fprog program{.len = filter.size(), .filter = filter.data()};
  if (prctl(PR_SET_NO_NEW_PRIVS, 1UL, 0UL, 0UL, 0UL) != 0) return false;
  const long listener = syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_NEW_LISTENER, &program);
  if (listener < 0) return false;
  listener_.store(static_cast<int>(listener));
  return true;
}

std::vector<SystemCall> SystemCallWatch::finish() {
  should_end_ = true;
  if (recorder_.joinable()) recorder_.join();
  return calls_;
}

void SystemCallWatch::record_calls() {
  // The watched thread cannot wake this one up: that would be a system call.
  while (listener_ < 0 && !should_end_)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const int listener = listener_;
  if (listener < 0) return;
  while (record_next_call(listener)) {
  }
  close(listener);
}

/// Returns false once the watched thread has ended.
bool SystemCallWatch::record_next_call(int listener) {
  pollfd ready{.fd = listener, .events = POLLIN, .revents = 0};
  if (poll(&ready, 1, -1) < 0) return true;
  if ((ready.revents & POLLIN) == 0) return false;
  seccomp_notif call{};
  if (ioctl(listener, SECCOMP_IOCTL_NOTIF_RECV, &call) != 0) return true;
  calls_.push_back({call.data.nr, counter_});
  seccomp_notif_resp go_on{.id = call.id, .val = 0, .error = 0, .flags = SECCOMP_USER_NOTIF_FLAG_CONTINUE};
  ioctl(listener, SECCOMP_IOCTL_NOTIF_SEND, &go_on);
  return true;
}

}  // namespace glissade::test_support
