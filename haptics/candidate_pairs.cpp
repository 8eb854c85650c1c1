#include <algorithm>
#include <utility>

#include <glissade/haptics/candidate_pairs.h>

namespace glissade::haptics {
namespace {

template <typename Pair>
std::span<const Pair> nearest(const std::vector<Pair>& pairs, double distance) {
  const auto end = std::upper_bound(pairs.begin(), pairs.end(), distance,
                                    [](double limit, const Pair& pair) { return limit < pair.distance; });
  return {pairs.data(), static_cast<std::size_t>(end - pairs.begin())};
}

}  // namespace

CandidatePairs::CandidatePairs(const Surroundings& surroundings, double greatest_radius, bool has_own_thread)
    : surroundings_(surroundings), search_(surroundings, greatest_radius) {
  if (has_own_thread) thread_.emplace();
}

CandidatePairs::~CandidatePairs() = default;

bool CandidatePairs::look(double reach, double ahead, std::span<const BodyPair> ignored) {
  bool is_other = false;
  if (!now_.covers(reach)) {
    if (thread_) thread_->wait();
    if (next_.covers(reach)) {
      std::swap(now_, next_);
    } else {
      ask(now_, reach, ahead, ignored);
      if (thread_) thread_->begin(search_, now_.request, now_.set);
    }
    next_.is_there = false;
    take(now_);
    is_other = true;
  }
  if (!next_.is_there && now_.drift > now_.half) {
    ask(next_, reach, ahead, ignored);
    if (thread_) thread_->begin(search_, next_.request, next_.set);
  }
  return is_other;
}

void CandidatePairs::ask(Search& search, double reach, double ahead, std::span<const BodyPair> ignored) const {
  search.request.X_WV.clear();
  for (const PlacedBody& part : surroundings_.bodies().subspan(surroundings_.obstacles().size()))
    search.request.X_WV.push_back(part.X_WB);
  search.request.radius = reach + ahead;
  search.request.ignored.assign(ignored.begin(), ignored.end());
  search.half = 0.5 * ahead;
  search.drift = 0.0;
  search.is_there = true;
}

/// Has the answer there. Without a thread it is looked for only now, when it is certain to be needed.
void CandidatePairs::take(Search& search) {
  if (thread_) {
    thread_->wait();
  } else {
    search_.find(search.request, search.set);
  }
  ++account_.searches;
  account_.reports += search.set.report;
}

void CandidatePairs::moved(double bound) {
  now_.drift += bound;
  next_.drift += bound;
}

void CandidatePairs::clear() {
  if (thread_) thread_->wait();
  now_.is_there = false;
  next_.is_there = false;
}

std::span<const CandidatePair> CandidatePairs::within(double reach) const {
  return nearest(now_.set.pairs, reach + now_.drift);
}

std::span<const Obligation> CandidatePairs::obligations(double reach) const {
  return nearest(now_.set.obligations, reach + now_.drift);
}

}  // namespace glissade::haptics
