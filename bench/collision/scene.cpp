#include "scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

namespace glissade::bench {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kNearResting = 10;

constexpr int kPlacements = 10'000;  // tries for one object

struct Coordinate {
  double place;
  double speed;
};

// A coordinate that changes at constant speed and bounces off both ends.
Coordinate bounced(double unbounded, double speed, double low, double high) {
  const double way = high - low;
  const double from_low = unbounded - low;
  const double there_and_back = std::fmod(std::abs(from_low), 2.0 * way);
  const double forward = from_low < 0.0 ? -speed : speed;
  if (there_and_back <= way) return {low + there_and_back, forward};
  return {low + 2.0 * way - there_and_back, -forward};
}

class Chance {
 public:
  explicit Chance(std::uint64_t seed) : random_(seed) {}

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  std::size_t index(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }
  Vector3d direction() {
    Vector3d v;
    std::generate(v.begin(), v.end(), [this] { return normal(); });
    return v.normalized();
  }
  Eigen::Matrix3d rotation() {
    Eigen::Vector4d q;
    std::generate(q.begin(), q.end(), [this] { return normal(); });
    return Eigen::Quaterniond(q).normalized().toRotationMatrix();
  }

 private:
  double normal() { return normal_(random_); }

  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

double edge_of_box(const Scene& scene, std::span<const double> radii, double filled) {
  double spheres_m3 = 0.0;
  for (const Flight& flight : scene)
    spheres_m3 += 4.0 / 3.0 * std::numbers::pi * std::pow(radii[flight.model], 3);
  return std::cbrt(spheres_m3 / filled);
}

void stop(Flight& flight) {
  flight.legs.front().v_W.setZero();
  flight.turning = 0.0;
}

void shift(Flight& flight, const Vector3d& by_W) {
  flight.low_W += by_W;
  flight.high_W += by_W;
  flight.legs.front().p_WO += by_W;
}

// Calls place(flight, chance) → p_WO for each object in turn.
template <typename Place>
Scene fill_box(std::span<const double> radii, std::size_t count, double filled, std::uint64_t seed,
               const Place& place) {
  Chance chance(seed);
  Scene scene(count);
  for (Flight& flight : scene)
    flight.model = chance.index(radii.size());
  const double edge = edge_of_box(scene, radii, filled);
  for (Flight& flight : scene) {
    flight.low_W.setConstant(radii[flight.model]);
    flight.high_W.setConstant(edge - radii[flight.model]);
    const Vector3d p_WO = place(flight, chance);
    flight.legs.push_back({0.0, p_WO, chance.uniform(0.3, 1.0) * chance.direction()});
    flight.R_WO = chance.rotation();
    flight.axis_O = chance.direction();
    flight.turning = chance.uniform(0.0, 3.0);
  }
  return scene;
}

Vector3d anywhere(const Flight& flight, Chance& chance) {
  const double x = chance.uniform(flight.low_W.x(), flight.high_W.x());
  const double y = chance.uniform(flight.low_W.y(), flight.high_W.y());
  return {x, y, chance.uniform(flight.low_W.z(), flight.high_W.z())};
}

}  // namespace

Leg Flight::leg_from(double time_s) const {
  const auto after = std::upper_bound(legs.begin() + 1, legs.end(), time_s,
                                      [](double time, const Leg& leg) { return time < leg.begin_s; });
  const Leg& leg = *(after - 1);
  Leg here{time_s, {}, {}};
  for (int i = 0; i < 3; ++i) {
    const Coordinate c = bounced(leg.p_WO(i) + (time_s - leg.begin_s) * leg.v_W(i), leg.v_W(i), low_W(i), high_W(i));
    here.p_WO(i) = c.place;
    here.v_W(i) = c.speed;
  }
  return here;
}

Eigen::Isometry3d Flight::pose(double time_s) const {
  Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
  X_WO.linear() = R_WO * Eigen::AngleAxisd(turning * time_s, axis_O).toRotationMatrix();
  X_WO.translation() = leg_from(time_s).p_WO;
  return X_WO;
}

Scene objects_in_box(std::span<const double> radii, std::size_t count, double filled, std::uint64_t seed) {
  return fill_box(radii, count, filled, seed, anywhere);
}

Scene objects_apart(std::span<const double> radii, std::size_t count, double filled, std::uint64_t seed) {
  std::vector<const Flight*> placed;
  return fill_box(radii, count, filled, seed, [&](const Flight& flight, Chance& chance) {
    const auto is_free = [&](const Vector3d& p_WO) {
      return std::none_of(placed.begin(), placed.end(), [&](const Flight* other) {
        return (other->legs.front().p_WO - p_WO).norm() < radii[other->model] + radii[flight.model];
      });
    };
    Vector3d p_WO = anywhere(flight, chance);
    for (int i = 0; !is_free(p_WO); ++i) {
      if (i == kPlacements) throw std::invalid_argument("the box is too full to place all objects apart");
      p_WO = anywhere(flight, chance);
    }
    placed.push_back(&flight);
    return p_WO;
  });
}

void bounce(Flight& a, Flight& b, double time_s) {
  Leg leg_a = a.leg_from(time_s);
  Leg leg_b = b.leg_from(time_s);
  const Vector3d n_W = (leg_b.p_WO - leg_a.p_WO).normalized();
  const double approach = (leg_a.v_W - leg_b.v_W).dot(n_W);
  if (!(approach > 0.0)) return;
  leg_a.v_W -= approach * n_W;
  leg_b.v_W += approach * n_W;
  a.legs.push_back(leg_a);
  b.legs.push_back(leg_b);
}

Scene one_among_resting(std::span<const double> radii, std::size_t resting, double filled, std::uint64_t seed) {
  Scene scene = objects_in_box(radii, kNearResting + 1, filled, seed);
  std::for_each(scene.begin() + 1, scene.end(), stop);
  if (resting <= kNearResting) return scene;
  Scene others = objects_in_box(radii, resting - kNearResting, filled, seed + 1);
  const double largest = *std::max_element(radii.begin(), radii.end());
  const double beyond = scene[0].high_W.x() + 2.0 * largest;
  for (Flight& other : others) {
    stop(other);
    shift(other, {beyond, 0.0, 0.0});
  }
  scene.insert(scene.end(), others.begin(), others.end());
  return scene;
}

std::vector<MovedObject> first_frame(const Scene& scene) {
  std::vector<MovedObject> all;
  for (std::size_t i = 0; i < scene.size(); ++i)
    all.push_back({i, scene[i].pose(0.0)});
  return all;
}

void moved_objects(const Scene& scene, int frame, std::vector<MovedObject>& moved) {
  moved.clear();
  for (std::size_t i = 0; i < scene.size(); ++i) {
    if (!scene[i].rests()) moved.push_back({i, scene[i].pose(frame * kFrame_s)});
  }
}

}  // namespace glissade::bench
