#pragma once

/// What a device has exerted, and when: for the work between two states.

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace glissade::devices {

/// The wrenches that were given to a device. Each acts `delay` after it was given, until the next one acts, and no
/// longer than `longest`: a device without commands exerts nothing. Not thread-safe. Real-time safe after construction.
class GivenWrenches {
 public:
  /// Has room for as many as `give` can take in these times, one each `period` and ten in a millisecond.
  GivenWrenches(std::chrono::nanoseconds delay, std::chrono::nanoseconds longest,
                std::chrono::nanoseconds period = std::chrono::microseconds(100))
      : delay_(delay),
        longest_(longest),
        wrenches_(64 + static_cast<std::size_t>((delay + longest) / std::min<std::chrono::nanoseconds>(
                                                                        period, std::chrono::microseconds(100)))) {}

  /// At `now` the device gets force (N) and torque (Nm). A time before the last one counts as that.
  void give(std::chrono::nanoseconds now, const Eigen::Vector3d& f, const Eigen::Vector3d& t) noexcept {
    const bool is_zero = f.isZero(0.0) && t.isZero(0.0);
    if (count_ > 0) {
      const Wrench& last = at(count_ - 1);
      if (is_zero && last.f.isZero(0.0) && last.t.isZero(0.0))
        return;  // so a silence does not displace what was before
      now = std::max(now, last.given);
    }
    if (count_ == wrenches_.size()) drop_oldest();
    wrenches_[(first_ + count_++) % wrenches_.size()] = {now, f, t};
  }

  /// The work (J) on a hand whose motion between `begin` and `end`, which is later, is so far: `moved` and `turned` are
  /// functions of the share of this time, from 0 to 1, and return the way until then (m, rad).
  template <typename Moved, typename Turned>
  double work(std::chrono::nanoseconds begin, std::chrono::nanoseconds end, const Moved& moved,
              const Turned& turned) const noexcept {
    const double duration = std::chrono::duration<double>(end - begin).count();
    const auto share = [&](std::chrono::nanoseconds time) {
      return std::clamp(std::chrono::duration<double>(time - begin).count() / duration, 0.0, 1.0);
    };
    double sum = 0.0;
    for (std::size_t i = 0; i < count_; ++i) {
      const Wrench& wrench = at(i);
      const std::chrono::nanoseconds from = wrench.given + delay_;
      std::chrono::nanoseconds until = from + longest_;
      if (i + 1 < count_) until = std::min(until, at(i + 1).given + delay_);
      const double a = share(from);
      const double b = share(until);
      if (b > a) sum += wrench.f.dot(moved(b) - moved(a)) + wrench.t.dot(turned(b) - turned(a));
    }
    return sum;
  }

  /// Forgets what acts no more at this time.
  void forget_until(std::chrono::nanoseconds time) noexcept {
    while (count_ > 1 && at(1).given + delay_ <= time)
      drop_oldest();
  }

  /// The work (J) that those before the newest will still do on a hand that goes on at velocity v (m/s) and w (rad/s).
  double work_to_come(std::chrono::nanoseconds now, const Eigen::Vector3d& v, const Eigen::Vector3d& w) const noexcept {
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < count_; ++i) {
      const std::chrono::nanoseconds from = at(i).given + delay_;
      const std::chrono::nanoseconds until = std::min(from + longest_, at(i + 1).given + delay_);
      const double seconds = std::chrono::duration<double>(until - std::max(from, now)).count();
      if (seconds > 0.0) sum += seconds * (at(i).f.dot(v) + at(i).t.dot(w));
    }
    return sum;
  }

 private:
  struct Wrench {
    std::chrono::nanoseconds given{0};
    Eigen::Vector3d f = Eigen::Vector3d::Zero();
    Eigen::Vector3d t = Eigen::Vector3d::Zero();
  };

  const Wrench& at(std::size_t i) const noexcept { return wrenches_[(first_ + i) % wrenches_.size()]; }
  void drop_oldest() noexcept {
    first_ = (first_ + 1) % wrenches_.size();
    --count_;
  }

  std::chrono::nanoseconds delay_;
  std::chrono::nanoseconds longest_;
  std::vector<Wrench> wrenches_;  // a ring
  std::size_t first_ = 0;
  std::size_t count_ = 0;
};

}  // namespace glissade::devices
