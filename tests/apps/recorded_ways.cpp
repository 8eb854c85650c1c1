#include "recorded_ways.h"

#include <algorithm>
#include <memory>

#include <glissade/geometry/mesh_generators.h>

#include "moving_boxes.h"

namespace glissade::test_support {

using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace {

constexpr std::size_t kPosesAtOnce = 20'000;

geometry::TriangleMesh mesh_of(const Vector3d& half) {
  if (half.z() == 0.0) return geometry::make_plate(2.0 * half.head<2>(), 2);
  return geometry::make_box(2.0 * half, 12);
}

}  // namespace

RecordedWays::RecordedWays(const std::vector<BoxOfScene>& obstacles, const std::vector<BoxOfScene>& parts)
    : first_part_(obstacles.size()) {
  for (const auto* const group : {&obstacles, &parts}) {
    for (const BoxOfScene& box : *group) {
      halves_.push_back(box.half);
      meshes_.push_back(mesh_of(box.half));
      grids_.emplace_back(
          std::vector<reference::PlacedMesh>{{std::make_shared<geometry::TriangleMesh>(meshes_.back())}});
      last_.push_back(box.X_WB);
    }
  }
  for (std::size_t part = first_part_; part < halves_.size(); ++part) {
    for (std::size_t other = 0; other < part; ++other)
      pairs_.emplace_back(other, part);
  }
  X_AB_.resize(pairs_.size());
}

void RecordedWays::take(const Poses& X_WV) {
  ++figures_.answers;
  Poses now(last_.begin(), last_.begin() + static_cast<std::ptrdiff_t>(first_part_));
  now.insert(now.end(), X_WV.begin(), X_WV.end());
  note_poses(now);
  const bool moves = !std::equal(now.begin(), now.end(), last_.begin(),
                                 [](const Isometry3d& a, const Isometry3d& b) { return a.matrix() == b.matrix(); });
  if (moves) {
    ++figures_.ways;
    if (const std::optional<Pair> blocked = what_meets(last_, now)) {
      constexpr std::array<double, 3> kAside_m{20e-6, 0.1e-3, 0.4e-3};
      const bool is_free = std::any_of(kAside_m.begin(), kAside_m.end(),
                                       [&](double aside) { return has_detour(last_, now, *blocked, aside); });
      ++(is_free ? figures_.detours : figures_.blocked);
      if (!is_free)
        fault("no free way for bodies " + std::to_string(blocked->first) + " and " + std::to_string(blocked->second));
    }
  }
  last_ = std::move(now);
}

const WayFigures& RecordedWays::finish() {
  check_poses();
  return figures_;
}

/// A pair of bodies not proven apart on the way of all bodies.
std::optional<RecordedWays::Pair> RecordedWays::what_meets(const Poses& from, const Poses& to) const {
  for (const Pair& pair : pairs_) {
    const MovingBox a{halves_[pair.first], from[pair.first], to[pair.first]};
    const MovingBox b{halves_[pair.second], from[pair.second], to[pair.second]};
    if (!(a.stands_still() && b.stands_still()) && !stay_apart(a, b)) return pair;
  }
  return std::nullopt;
}

/// Whether all bodies get there by poses half-way at which those that block each other are moved apart.
bool RecordedWays::has_detour(const Poses& from, const Poses& to, Pair blocked, double aside) const {
  constexpr int kMostPairs = 4;
  Poses via;
  for (std::size_t body = 0; body < from.size(); ++body)
    via.push_back(MovingBox{halves_[body], from[body], to[body]}.at(0.5));
  for (int i = 0; i < kMostPairs; ++i) {
    if (!move_apart(from, to, blocked, aside, via)) return false;
    std::optional<Pair> next = what_meets(from, via);
    if (!next) next = what_meets(via, to);
    if (!next) return true;
    blocked = *next;
  }
  return false;
}

bool RecordedWays::move_apart(const Poses& from, const Poses& to, Pair pair, double aside, Poses& via) const {
  const auto [a, b] = pair;
  const auto n_from = separating_axis(halves_[a], from[a], halves_[b], from[b]);
  const auto n_to = separating_axis(halves_[a], to[a], halves_[b], to[b]);
  if (!n_from || !n_to) return false;
  const Vector3d way = aside * (*n_from + *n_to).stableNormalized();
  via[b].translation() += way;
  if (a >= first_part_) via[a].translation() -= way;
  return true;
}

void RecordedWays::note_poses(const Poses& now) {
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const auto [a, b] = pairs_[i];
    const bool is_known =
        figures_.answers > 1 && now[a].matrix() == last_[a].matrix() && now[b].matrix() == last_[b].matrix();
    if (!is_known) X_AB_[i].push_back(now[a].inverse(Eigen::Isometry) * now[b]);
  }
  if (X_AB_.back().size() >= kPosesAtOnce || X_AB_.front().size() >= kPosesAtOnce) check_poses();
}

void RecordedWays::check_poses() {
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const auto [a, b] = pairs_[i];
    const std::vector<char> collides = grids_[a].collisions(meshes_[b], X_AB_[i]);
    const std::ptrdiff_t count = std::count(collides.begin(), collides.end(), 1);
    figures_.poses += std::ssize(collides);
    figures_.colliding += count;
    if (count > 0) fault("bodies " + std::to_string(a) + " and " + std::to_string(b) + " collide");
    X_AB_[i].clear();
  }
}

void RecordedWays::fault(const std::string& text) {
  if (figures_.first_fault.empty())
    figures_.first_fault = text + ", at or before answer " + std::to_string(figures_.answers);
}

}  // namespace glissade::test_support
