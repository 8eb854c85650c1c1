#include "two_hand_scripts.h"

#include <algorithm>
#include <cstdio>
#include <vector>

#include <Eigen/Geometry>

#include "random_numbers.h"

namespace glissade::test_support {

using Eigen::Vector3d;

namespace {

constexpr double kLesson_s = 6.0;
constexpr double kRest_s = 1.5;
constexpr double kAfter_s = 10.0;
constexpr double kRoom_m = 0.06;

struct Row {
  double t_s;
  Vector3d p_WH;
  bool is_closed;
};

const std::vector<Row> kFirst{
    {0.0, {-0.03, 0.0, 0.0}, true},  {0.8, {-0.03, 0.0, 0.04}, true},  {1.3, {-0.03, 0.0, 0.04}, true},
    {1.8, {-0.03, 0.0, 0.06}, true}, {2.2, {-0.03, 0.0, 0.06}, false}, {3.0, {0.05, 0.0, 0.0}, false},
    {3.2, {0.05, 0.0, 0.0}, true},   {5.4, {0.05, 0.0, 0.0}, true},    {5.65, {0.05, 0.0, 0.0}, false}};
const std::vector<Row> kSecond{
    {0.0, {0.0, -0.06, 0.04}, false},  {0.8, {-0.03, -0.02, 0.04}, false}, {1.0, {-0.03, -0.02, 0.04}, true},
    {3.0, {-0.03, -0.02, 0.04}, true}, {3.4, {-0.03, -0.02, 0.0}, true},   {4.2, {0.01, -0.02, 0.0}, true},
    {4.8, {0.01, -0.02, 0.0}, false},  {5.2, {0.01, -0.02, 0.0}, true},    {5.6, {0.01, -0.02, 0.0}, false}};

class ScriptWriter {
 public:
  explicit ScriptWriter(const Row& first) : is_closed_(first.is_closed) {
    script_.csv = "t_s,x_m,y_m,z_m,qw,qx,qy,qz,grip\n";
    script_.grip = first.is_closed ? 1 : 0;
  }

  void add(const Row& row, const Eigen::Quaterniond& q_WH = Eigen::Quaterniond::Identity()) {
    char line[200];
    std::snprintf(line, sizeof line, "%.3f,%.5f,%.5f,%.5f,%.9f,%.9f,%.9f,%.9f,%d\n", row.t_s, row.p_WH.x(),
                  row.p_WH.y(), row.p_WH.z(), q_WH.w(), q_WH.x(), q_WH.y(), q_WH.z(), row.is_closed ? 1 : 0);
    script_.csv += line;
    script_.grip += row.is_closed != is_closed_ ? 1 : 0;
    is_closed_ = row.is_closed;
  }

  const GripScript& script() const { return script_; }

 private:
  GripScript script_;
  bool is_closed_;
};

/// A hand changes its grip every 50 to 90 ms, now and then after 200 to 500 ms, and wanders meanwhile.
GripScript script_of(const std::vector<Row>& lesson, double seconds, RandomNumbers random) {
  ScriptWriter writer(lesson.front());
  for (const Row& row : lesson)
    writer.add(row);
  Row row = lesson.back();
  row.t_s = kLesson_s;
  writer.add(row);
  Vector3d turn = Vector3d::Zero();  // rotation vector, rad
  while (true) {
    const double wait_s = random.chance(0.12) ? random.uniform(0.2, 0.5) : random.uniform(0.05, 0.09);
    row.t_s += wait_s;
    if (row.t_s > seconds - kRest_s) break;
    const Vector3d way = random.point(0.25 * std::min(wait_s, 0.2));
    row.p_WH = (row.p_WH + way).cwiseMax(-kRoom_m).cwiseMin(kRoom_m);
    turn = (turn + random.point(wait_s)).cwiseMax(-0.4).cwiseMin(0.4);
    row.is_closed = !row.is_closed;
    writer.add(row, Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.stableNormalized())));
  }
  row.t_s = std::max(seconds, kLesson_s) + kAfter_s;
  writer.add(row);
  return writer.script();
}

}  // namespace

std::array<GripScript, 2> two_hand_scripts(double seconds, std::uint64_t seed) {
  return {script_of(kFirst, seconds, RandomNumbers(2 * seed)),
          script_of(kSecond, seconds, RandomNumbers(2 * seed + 1))};
}

}  // namespace glissade::test_support
