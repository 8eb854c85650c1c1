#include "scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace glissade::bench {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kNearResting = 10;

// Where something is that moves evenly and bounces off both ends.
double bounced(double unbounded, double low, double high) {
  const double way = high - low;
  const double there_and_back = std::fmod(std::abs(unbounded - low), 2.0 * way);
  return low + (there_and_back <= way ? there_and_back : 2.0 * way - there_and_back);
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
  flight.v_W.setZero();
  flight.turning = 0.0;
}

void shift(Flight& flight, const Vector3d& by_W) {
  flight.low_W += by_W;
  flight.high_W += by_W;
  flight.p_WO += by_W;
}

}  // namespace

Eigen::Isometry3d Flight::pose(double time_s) const {
  Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
  X_WO.linear() = R_WO * Eigen::AngleAxisd(turning * time_s, axis_O).toRotationMatrix();
  for (int i = 0; i < 3; ++i)
    X_WO.translation()(i) = bounced(p_WO(i) + time_s * v_W(i), low_W(i), high_W(i));
  return X_WO;
}

Scene bouncing_objects(std::span<const double> radii, std::size_t count, double filled, std::uint64_t seed) {
  Chance chance(seed);
  Scene scene(count);
  for (Flight& flight : scene)
    flight.model = chance.index(radii.size());
  const double edge = edge_of_box(scene, radii, filled);
  for (Flight& flight : scene) {
    const double radius = radii[flight.model];
    flight.low_W.setConstant(radius);
    flight.high_W.setConstant(edge - radius);
    for (double& coordinate : flight.p_WO)
      coordinate = chance.uniform(radius, edge - radius);
    flight.v_W = chance.uniform(0.3, 1.0) * chance.direction();
    flight.R_WO = chance.rotation();
    flight.axis_O = chance.direction();
    flight.turning = chance.uniform(0.0, 3.0);
  }
  return scene;
}

Scene one_among_resting(std::span<const double> radii, std::size_t resting, double filled, std::uint64_t seed) {
  Scene scene = bouncing_objects(radii, kNearResting + 1, filled, seed);
  std::for_each(scene.begin() + 1, scene.end(), stop);
  if (resting <= kNearResting) return scene;
  Scene others = bouncing_objects(radii, resting - kNearResting, filled, seed + 1);
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
