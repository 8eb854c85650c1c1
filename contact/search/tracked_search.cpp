#include "search/tracked_search.h"

namespace glissade::contact {
namespace {

// Shares of the look-ahead:
/// The drift at which the next search is requested. Earlier, more of them are in vain; later, a thread has less time.
constexpr double kAskAt = 0.4;
/// The way away from the poses of a search after which a part is leaving them.
constexpr double kLeaving = 0.1;
/// The same before its answer is taken, and of its step: the part has turned back, and the search is of no use.
constexpr double kTurnedBack = 0.4;

}  // namespace

void TrackedSearch::follow(const ContactScene& scene, std::span<const Eigen::Isometry3d> X_WB) {
  if (!is_there) return;
  drift = approach(scene, request.X_WB, X_WB, motions);
  if (!(drift < least_drift)) return;
  least_drift = drift;
  X_WB_nearest.assign(X_WB.begin(), X_WB.end());
}

bool TrackedSearch::is_being_left() const {
  return drift > kAskAt * ahead && drift > least_drift + kLeaving * ahead;
}

bool TrackedSearch::is_in_vain() const {
  return drift > least_drift + kTurnedBack * (step + ahead);
}

}  // namespace glissade::contact
