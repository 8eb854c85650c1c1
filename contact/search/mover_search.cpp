#include "search/mover_search.h"

#include <algorithm>
#include <array>
#include <type_traits>
#include <utility>

namespace glissade::contact {
namespace {

constexpr double kGreatestRadiusOfMover_m = 0.1;
// A search looks so many times as far as it must, so that it serves for several calls; so far at least where nothing is
// near.
constexpr double kAheadOfMover = 1.5;
constexpr double kRadiusOfNothing_m = 1e-3;
// Work of a search, and of each pair that it finds: rough.
constexpr std::int64_t kWorkOfMoverSearch = 1000;
constexpr std::int64_t kWorkOfMoverPair = 300;

}  // namespace

NearMover::NearMover(std::vector<Obstacle> bodies, std::int32_t first_body,
                     const std::shared_ptr<const SlidingPart>& mover, double margin)
    : first_body_(first_body),
      scene_(std::move(bodies), {mover}, 1, std::array{margin}, std::array{ContactScene::kChain}),
      candidates_(scene_, kGreatestRadiusOfMover_m, /*runs_ahead=*/false, kUnlimitedWork, /*has_planes=*/false) {}

void NearMover::place_bodies(const Eigen::Isometry3d& X_WS) {
  X_WS_ = X_WS;
  place();
}

void NearMover::place_mover(const Eigen::Isometry3d& X_WM) {
  X_WM_ = X_WM;
  place();
}

void NearMover::place() {
  scene_.place(0, X_WS_.inverse(Eigen::Isometry) * X_WM_);
  has_moved_ = true;
}

bool NearMover::look(double reach) {
  if (std::exchange(has_moved_, false)) candidates_.moved();
  if (reach * kAheadOfMover > kGreatestRadiusOfMover_m) return false;
  const double radius = std::max(kAheadOfMover * reach, candidates_.pairs().size() == 0 ? kRadiusOfNothing_m : 0.0);
  candidates_.begin_call();
  const bool is_new = candidates_.look(reach, radius - reach, {});
  if (is_new) work_ += kWorkOfMoverSearch + kWorkOfMoverPair * static_cast<std::int64_t>(candidates_.pairs().size());
  return true;
}

template <typename Pair>
void NearMover::add_within(double reach, std::int32_t number, std::vector<Pair>& all) {
  if (candidates_.pairs().size() == 0) return;
  std::vector<Pair>* found = nullptr;
  if constexpr (std::is_same_v<Pair, TrianglesOfBodies>) {
    found = &pairs_;
  } else {
    found = &to_certify_;
  }
  candidates_.pairs().within(reach, *found);
  for (Pair& pair : *found) {
    pair.bodies = {first_body_ + pair.bodies.obstacle, number};
    if constexpr (std::is_same_v<Pair, PairToCertify>) pair.n_W = X_WS_.linear() * pair.n_W;
    all.push_back(pair);
  }
}

template void NearMover::add_within(double, std::int32_t, std::vector<TrianglesOfBodies>&);
template void NearMover::add_within(double, std::int32_t, std::vector<PairToCertify>&);

MoverSearch::MoverSearch(const std::vector<Obstacle>& fixed,
                         const std::vector<std::shared_ptr<const SlidingPart>>& objects,
                         const std::shared_ptr<const SlidingPart>& mover, double margin) {
  if (!fixed.empty()) of_fixed_ = std::make_unique<NearMover>(fixed, 0, mover, margin);
  for (const auto& object : objects) {
    const auto number = static_cast<std::int32_t>(fixed.size() + of_objects_.size());
    std::vector<Obstacle> bodies{{.body = object, .X_WO = Eigen::Isometry3d::Identity(), .name = "an object"}};
    of_objects_.push_back(std::make_unique<NearMover>(std::move(bodies), number, mover, margin));
  }
}

void MoverSearch::place_mover(const Eigen::Isometry3d& X_WM) {
  if (of_fixed_) of_fixed_->place_mover(X_WM);
  for (const auto& near : of_objects_)
    near->place_mover(X_WM);
}

bool MoverSearch::look(double reach) {
  reach_ = reach;
  if (of_fixed_ && !of_fixed_->look(reach)) return false;
  return std::all_of(of_objects_.begin(), of_objects_.end(), [&](const auto& near) { return near->look(reach); });
}

std::size_t MoverSearch::pair_count() const {
  std::size_t count = of_fixed_ ? of_fixed_->pair_count() : 0;
  for (const auto& near : of_objects_)
    count += near->pair_count();
  return count;
}

std::int64_t MoverSearch::work() const {
  std::int64_t work = of_fixed_ ? of_fixed_->work() : 0;
  for (const auto& near : of_objects_)
    work += near->work();
  return work;
}

}  // namespace glissade::contact
