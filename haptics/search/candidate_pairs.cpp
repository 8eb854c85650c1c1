#include "search/candidate_pairs.h"

#include <utility>

#include <glissade/geometry/displacement.h>

namespace glissade::haptics {

template <typename Pair>
void CandidatePairs::Search::collect(const std::vector<Pair>& pairs, double reach, std::vector<Pair>& found) const {
  found.clear();
  for (const Pair& pair : pairs) {
    if (pair.distance > reach + drift) return;  // as are all that follow
    if (still_apart(pair.bodies, pair.distance, pair.n_W) <= reach) found.push_back(pair);
  }
}

CandidatePairs::CandidatePairs(const ContactScene& scene, double greatest_radius, bool has_own_thread)
    : scene_(scene), search_(scene, greatest_radius) {
  if (has_own_thread) thread_.emplace();
}

CandidatePairs::~CandidatePairs() = default;

bool CandidatePairs::look(double reach, double ahead, std::span<const BodyPair> ignored) {
  bool is_other = false;
  if (!now_.covers(reach)) {
    const bool takes_next = next_.covers(reach);
    forget();
    if (thread_) thread_->wait();
    if (takes_next) {
      std::swap(now_, next_);
    } else {
      ask(now_, reach, ahead, ignored);
    }
    answer(now_);
    now_.is_there = true;
    is_other = true;
  }
  if (!next_.is_there && now_.drift > now_.half) {
    ask(next_, reach, ahead, ignored);
    next_.is_there = true;
  }
  return is_other;
}

void CandidatePairs::ask(Search& search, double reach, double ahead, std::span<const BodyPair> ignored) {
  search.request.X_WV.clear();
  for (const PlacedBody& part : scene_.bodies().subspan(scene_.obstacles().size()))
    search.request.X_WV.push_back(part.X_WB);
  search.request.radius = reach + ahead;
  search.request.ignored.assign(ignored.begin(), ignored.end());
  search.half = 0.5 * ahead;
  search.motions.assign(scene_.bodies().size(), {});
  search.drift = 0.0;
  if (thread_) thread_->begin(search_, search.request, search.set);
}

/// Gets the answer to a request. Without a thread, the search runs only now, when its answer is certainly needed.
void CandidatePairs::answer(Search& search) {
  if (thread_) {
    thread_->wait();
  } else {
    search_.find(search.request, search.set);
  }
  ++statistics_.searches;
  statistics_.reports += search.set.report;
}

void CandidatePairs::moved() {
  follow(now_);
  follow(next_);
}

void CandidatePairs::follow(Search& search) const {
  if (!search.is_there) return;
  search.drift = 0.0;
  for (std::size_t p = 0; p < search.request.X_WV.size(); ++p) {
    const std::size_t body = scene_.body_of_part(p);
    const SlidingPart& part = *scene_.parts()[p];
    const geometry::Displacement d =
        geometry::displacement_between(search.request.X_WV[p], scene_.bodies()[body].X_WB, part.p_Vref());
    const double all = geometry::motion_bound(d, part.radius());
    search.motions[body] = {d.v, all - d.v.norm()};
    search.drift += all;
  }
}

void CandidatePairs::clear() {
  forget();
  if (thread_) thread_->wait();
}

/// Also called before a search, which may throw and leave its answer unfinished.
void CandidatePairs::forget() {
  now_.is_there = false;
  next_.is_there = false;
}

template void CandidatePairs::Search::collect(const std::vector<CandidatePair>&, double,
                                              std::vector<CandidatePair>&) const;
template void CandidatePairs::Search::collect(const std::vector<PairToCertify>&, double,
                                              std::vector<PairToCertify>&) const;

}  // namespace glissade::haptics
