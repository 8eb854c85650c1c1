#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include <glissade/shapes/benchmark_shapes.h>

#include "surfaces/patch_solids.h"

namespace glissade::shapes {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

constexpr double kCuffRadius = 0.034;
constexpr double kCuffPart = 0.1;  // of the hose's length, at either end
constexpr double kInnerRadius = 0.029;

/// A cubic curve from the intake at the lower rear to the engine at the upper front.
Vector3d path(double t) {
  const Vector3d a(-0.29, 0, -0.06), b(0.12, -0.02, -0.22), c(-0.2, 0.3, 0.28), d(0.29, 0.1, 0.06);
  const double s = 1 - t;
  return s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * d;
}

using SharedSpine = std::shared_ptr<const Spine>;

Vector2d on_circle(double turns, double radius) {
  return radius * Vector2d(std::cos(2 * pi * turns), std::sin(2 * pi * turns));
}

/// Round wall along the spine from the part t_first to t_last of its length; `radius` over the span parameter.
void add_round_wall(PatchWork& work, const SharedSpine& spine, double t_first, double t_last, const Axis& along,
                    const std::function<double(double)>& radius, int least_around) {
  const auto spans = static_cast<double>(along.spans.size());
  work.add({{{2 * pi * kCuffRadius, least_around}}, true}, along, [=](double u, double v) {
    const double t = t_first + (t_last - t_first) * v / spans;
    return spine->point(t, on_circle(u, radius(v)));
  });
}

/// A solid of revolution whose profile (r, distance along the spine in metres) is bent with the hose.
void add_collar(PatchWork& work, const SharedSpine& spine, double t, const PlaneCurve& profile, int least_around) {
  work.add({{{2 * pi * kCuffRadius, least_around}}, true}, profile.axis,
           [=, point = profile.point](double u, double v) {
             const Vector2d p = point(v);
             return spine->point(t + p.y() / spine->length(), on_circle(u, p.x()));
           });
}

/// Band with a turned-up edge on either side, its worm housing and screw.
void add_clamp(PatchWork& work, const SharedSpine& spine, double t, bool is_complete) {
  const double r = kCuffRadius;
  const PlaneCurve band =
      rounded_path({{r + 0.0005, -0.006}, {r + 0.0005, 0.006}, {r + 0.002, 0.0045}, {r + 0.002, -0.0045}}, true);
  add_collar(work, spine, t, band, 8);
  if (!is_complete) return;
  PatchWork screw;
  add_turned(screw, rectangle({0.018, 0.012}, 0.002),
             rounded_path({{0, 0}, {1, 0}, {1, 0.007, 0.002}, {0.8, 0.009}, {0, 0.009}}, false));
  PatchWork head;
  add_prism(head, circle(0.0042, 6), -0.008, 0);
  add_prism(head, circle(0.0028, 8), 0, 0.03);
  screw.add(head, turned(pi / 2, Vector3d::UnitY(), {-0.011, 0, 0.0045}));
  // Local x around the band, y along the hose, z outwards.
  work.add(
      screw,
      [=](const Vector3d& p) {
        const double turns = 0.2 + p.x() / (2 * pi * (r + 0.004));
        return spine->point(t + p.y() / spine->length(), on_circle(turns, r + 0.001 + p.z()));
      },
      2);
}

/// Oval plate with two bolt holes and its bolts, across the end `t` of the hose.
void add_flange(PatchWork& work, const SharedSpine& spine, double t, bool is_complete) {
  const double side = t < 0.5 ? 1 : -1;
  PatchWork flange;
  add_pierced_prism(flange,
                    rounded_path({{-0.066, 0, 0.014}, {0, -0.062, 0.05}, {0.066, 0, 0.014}, {0, 0.062, 0.05}}, true),
                    kInnerRadius, 0, 0.006);
  if (is_complete) {
    PatchWork bolt;
    add_revolution(
        bolt,
        rounded_path({{0, -0.008}, {0.003, -0.008}, {0.003, 0.006}, {0.0075, 0.006}, {0.0075, 0.007}, {0, 0.007}},
                     false),
        8);
    add_prism(bolt, circle(0.0055, 6), 0.0075, 0.012);
    flange.add(bolt, shifted(-0.05, 0, 0), 2);
    flange.add(bolt, shifted(0.05, 0, 0), 2);
  }
  // Local z points from the end inwards; beyond the end, the flange continues straight.
  const Vector3d end = spine->point(t, Vector2d::Zero());
  const Vector3d inwards = (spine->point(t + side * 0.01, Vector2d::Zero()) - end).normalized();
  work.add(
      flange, [=](const Vector3d& p) -> Vector3d { return spine->point(t, p.head<2>()) + p.z() * inwards; }, 1.5);
  // A sealing lip between the flange and the cuff.
  const PlaneCurve lip =
      rounded_path({{kInnerRadius, 0.006}, {kCuffRadius + 0.004, 0.006}, {kCuffRadius, 0.014}}, false);
  PlaneCurve inward = lip;
  inward.point = [point = lip.point, side](double s) -> Vector2d { return point(s).cwiseProduct(Vector2d(1, side)); };
  add_collar(work, spine, t, inward, 8);
}

}  // namespace

geometry::TriangleMesh make_engine_hose(std::int64_t triangle_count) {
  const bool is_complete = triangle_count >= kDetailsFrom;
  const auto spine = std::make_shared<const Spine>(&path, 4000);
  const double length = spine->length();
  PatchWork work;

  // Folds in the middle of the hose, smooth waves that are steeper at their feet; the valleys keep the cuffs' radius.
  constexpr int kFolds = 16;
  const double fold = (1 - 2 * kCuffPart) * length / kFolds;
  const Axis folds{std::vector<Span>(kFolds, Span{2.2 * fold, 2})};
  add_round_wall(
      work, spine, kCuffPart, 1 - kCuffPart, folds,
      [](double v) { return kCuffRadius + 0.011 * std::pow(std::sin(pi * v), 2.0); }, 8);
  for (const double first : {0.0, 1 - kCuffPart}) {
    add_round_wall(
        work, spine, first, first + kCuffPart, {{{kCuffPart * length}}}, [](double) { return kCuffRadius; }, 8);
  }
  add_round_wall(
      work, spine, 0, 1, {{{length / 2, 10}}}, [](double) { return kInnerRadius; }, 6);
  for (const double t : {0.6 * kCuffPart, 1 - 0.6 * kCuffPart}) {
    add_clamp(work, spine, t, is_complete);
  }
  add_flange(work, spine, 0, is_complete);
  add_flange(work, spine, 1, is_complete);
  return work.tessellated(triangle_count);
}

}  // namespace glissade::shapes
