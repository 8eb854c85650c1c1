#include "recorded_ways.h"

#include <algorithm>
#include <memory>
#include <sstream>

#include <glissade/geometry/displacement.h>
#include <glissade/geometry/mesh_generators.h>

#include "moving_boxes.h"
#include "random_numbers.h"

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
      const bool is_free = goes_round(last_, now, *blocked) || goes_one_by_one(last_, now) || goes_somehow(last_, now);
      ++(is_free ? figures_.detours : figures_.blocked);
      if (!is_free) fault(*blocked, "have no free way to", {last_, now});
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

/// Whether there is a detour no farther aside than the parts move in all.
bool RecordedWays::goes_round(const Poses& from, const Poses& to, Pair blocked) const {
  const double most = length_of(from, to);
  for (double aside = 20e-6; aside < most; aside *= 2.0) {
    if (has_detour(from, to, blocked, aside)) return true;
  }
  return has_detour(from, to, blocked, most);
}

/// Whether the parts get there one after another in some order, each of them straight or by a detour.
bool RecordedWays::goes_one_by_one(const Poses& from, const Poses& to) const {
  bool is_there = true;
  for (std::size_t part = first_part_; part < from.size(); ++part) {
    if (from[part].matrix() == to[part].matrix()) continue;
    is_there = false;
    Poses next = from;
    next[part] = to[part];
    const std::optional<Pair> blocked = what_meets(from, next);
    if ((!blocked || goes_round(from, next, *blocked)) && goes_one_by_one(next, to)) return true;
  }
  return is_there;
}

/// Whether the parts get there by two random poses each.
bool RecordedWays::goes_somehow(const Poses& from, const Poses& to) const {
  constexpr int kTrials = 3000;
  constexpr std::uint64_t kSeed = 1;
  RandomNumbers random(kSeed);
  const double most = length_of(from, to);
  for (int trial = 0; trial < kTrials; ++trial) {
    const double aside = most * random.power_of_ten(-2.0, 0.0);
    Poses leave = from;
    Poses arrive = to;
    for (std::size_t part = first_part_; part < from.size(); ++part) {
      const double radius = halves_[part].norm();
      for (Poses* const via : {&leave, &arrive}) {
        const geometry::Displacement d{aside * random.direction(), aside / radius * random.direction()};
        (*via)[part] = geometry::displaced((*via)[part], Vector3d::Zero(), d);
      }
    }
    if (!what_meets(from, leave) && !what_meets(leave, arrive) && !what_meets(arrive, to)) return true;
  }
  return false;
}

/// Whether all bodies get there if those that block each other go apart first, and come together again at the end.
bool RecordedWays::has_detour(const Poses& from, const Poses& to, Pair blocked, double aside) const {
  constexpr int kMostPairs = 4;
  Poses leave = from;
  Poses arrive = to;
  for (int i = 0; i < kMostPairs; ++i) {
    if (!move_apart(blocked, aside, from, leave) || !move_apart(blocked, aside, to, arrive)) return false;
    std::optional<Pair> next = what_meets(from, leave);
    if (!next) next = what_meets(leave, arrive);
    if (!next) next = what_meets(arrive, to);
    if (!next) return true;
    blocked = *next;
  }
  return false;
}

/// Moves two bodies of `via` apart, along the direction in which they are apart at the poses `at`.
bool RecordedWays::move_apart(Pair pair, double aside, const Poses& at, Poses& via) const {
  const auto [a, b] = pair;
  const auto n = separating_axis(halves_[a], at[a], halves_[b], at[b]);
  if (!n) return false;
  via[b].translation() += aside * *n;
  if (a >= first_part_) via[a].translation() -= aside * *n;
  return true;
}

/// The sum of the ways of all bodies, metres: of the point of each that moves farthest.
double RecordedWays::length_of(const Poses& from, const Poses& to) const {
  double length = 0.0;
  for (std::size_t body = first_part_; body < from.size(); ++body) {
    const geometry::Displacement d = geometry::displacement_between(from[body], to[body], Vector3d::Zero());
    length += geometry::motion_bound(d, halves_[body].norm());
  }
  return length;
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
    if (count > 0) fault(pairs_[i], "collide in or before");
    X_AB_[i].clear();
  }
}

void RecordedWays::fault(Pair pair, const std::string& what, std::initializer_list<Poses> poses) {
  if (!figures_.first_fault.empty()) return;
  std::ostringstream text;
  text.precision(17);
  text << "bodies " << pair.first << " and " << pair.second << ' ' << what << " answer " << figures_.answers;
  for (const Poses& of_all : poses) {
    for (std::size_t part = first_part_; part < of_all.size(); ++part)
      text << '\n' << of_all[part].matrix().topRows<3>();
  }
  figures_.first_fault = text.str();
}

}  // namespace glissade::test_support
