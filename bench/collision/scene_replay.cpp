#include "scene_replay.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <numeric>
#include <utility>

#include "interleaved_passes.h"

namespace glissade::bench {
namespace {

using Clock = std::chrono::steady_clock;

std::vector<NumberPair> in_order(std::vector<NumberPair> pairs) {
  for (NumberPair& pair : pairs) {
    if (pair.second < pair.first) std::swap(pair.first, pair.second);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// The progress of one subject through the frames.
class Player {
 public:
  Player(const Scene& scene, SceneSubject& subject, const ReplayLimits& limits)
      : scene_(scene), subject_(subject), limits_(limits) {}

  // A slow subject stops early, after a tenth of its time: it takes the first of these frames only.
  void run_in() {
    const double most_us = 1e6 * limits_.seconds / 10.0;
    double spent_us = step(0);
    for (int frame = 1; frame < limits_.run_in && spent_us < most_us; ++frame)
      spent_us += step(frame);
  }

  void take_turn(int first, int end) {
    for (int frame = first; frame < end && !is_done(); ++frame) {
      const double us = step(frame);
      spent_us_ += us;
      if (frame < first + limits_.warm_up) continue;
      FrameRecord record{frame, us, in_order(subject_.meeting()), {}};
      if (subject_.report() != nullptr) record.report = *subject_.report();
      records_.push_back(std::move(record));
    }
  }

  std::vector<FrameRecord> records() && { return std::move(records_); }

 private:
  bool is_done() const { return spent_us_ > 1e6 * limits_.seconds && std::ssize(records_) >= limits_.least; }

  double step(int frame) {
    moved_objects(scene_, frame, moved_);
    const Clock::time_point start = Clock::now();
    subject_.step(moved_);
    return std::chrono::duration<double, std::micro>(Clock::now() - start).count();
  }

  const Scene& scene_;
  SceneSubject& subject_;
  const ReplayLimits& limits_;
  std::vector<MovedObject> moved_;
  std::vector<FrameRecord> records_;
  double spent_us_ = 0.0;
};

// Calls visit(record, other) for the frames that both have.
template <typename Visit>
void for_common_frames(std::span<const FrameRecord> frames, std::span<const FrameRecord> others, const Visit& visit) {
  auto other = others.begin();
  for (const FrameRecord& record : frames) {
    while (other != others.end() && other->frame < record.frame)
      ++other;
    if (other != others.end() && other->frame == record.frame) visit(record, *other);
  }
}

std::vector<double> common_times_us(std::span<const FrameRecord> frames, std::span<const FrameRecord> others) {
  std::vector<double> times;
  for_common_frames(frames, others, [&](const FrameRecord& record, const FrameRecord&) { times.push_back(record.us); });
  return times;
}

}  // namespace

void play(Scene& scene, SceneSubject& referee, int frames) {
  std::vector<MovedObject> moved;
  for (int frame = 0; frame < frames; ++frame) {
    moved_objects(scene, frame, moved);
    referee.step(moved);
    for (const auto& [a, b] : in_order(referee.meeting()))
      bounce(scene[a], scene[b], frame * kFrame_s);
  }
}

std::vector<std::vector<FrameRecord>> replay(const Scene& scene,
                                             std::span<const std::unique_ptr<SceneSubject>> subjects,
                                             const ReplayLimits& limits) {
  std::vector<Player> players;
  for (const auto& subject : subjects)
    players.emplace_back(scene, *subject, limits);
  for (Player& player : players)
    player.run_in();
  std::vector<Player*> order;
  for (Player& player : players)
    order.push_back(&player);
  const int end = limits.run_in + limits.frames;
  for (int first = limits.run_in; first < end; first += limits.turn) {
    for (Player* const player : order)
      player->take_turn(first, std::min(first + limits.turn, end));
    // The first subject finds the shared models out of the cache; the next time another one is first.
    std::rotate(order.begin(), order.begin() + 1, order.end());
  }
  std::vector<std::vector<FrameRecord>> all;
  for (Player& player : players)
    all.push_back(std::move(player).records());
  return all;
}

double median_us(std::span<const FrameRecord> frames, std::span<const FrameRecord> others) {
  return median(common_times_us(frames, others));
}

double mean_us(std::span<const FrameRecord> frames, std::span<const FrameRecord> others) {
  const std::vector<double> times = common_times_us(frames, others);
  return std::accumulate(times.begin(), times.end(), 0.0) / static_cast<double>(times.size());
}

double percentile_99_us(std::span<const FrameRecord> frames) {
  std::vector<double> times = common_times_us(frames, frames);
  const std::size_t above = times.size() / 100;  // number of frames that may take longer
  const auto found = times.end() - 1 - static_cast<std::ptrdiff_t>(above);
  std::nth_element(times.begin(), found, times.end());
  return *found;
}

std::int64_t differences(std::span<const FrameRecord> frames, std::span<const FrameRecord> others) {
  std::int64_t count = 0;
  for_common_frames(frames, others, [&](const FrameRecord& record, const FrameRecord& other) {
    std::vector<NumberPair> in_one;
    std::set_symmetric_difference(record.meeting.begin(), record.meeting.end(), other.meeting.begin(),
                                  other.meeting.end(), std::back_inserter(in_one));
    count += std::ssize(in_one);
  });
  return count;
}

}  // namespace glissade::bench
