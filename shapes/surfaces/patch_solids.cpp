#include "surfaces/patch_solids.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace glissade::shapes {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

/// A straight piece from `start` to `end`, or an arc about `center` where radius > 0.
struct Piece {
  Vector2d start;
  Vector2d end;
  Vector2d center = Vector2d::Zero();
  double radius = 0;
  double first_angle = 0;
  double sweep = 0;

  Vector2d at(double t) const {
    if (radius == 0) return start + t * (end - start);
    const double angle = first_angle + t * sweep;
    return center + radius * Vector2d(std::cos(angle), std::sin(angle));
  }
};

/// The arc that rounds the corner at `here` between the directions to its neighbors.
Piece arc(const Vector2d& before, const Vector2d& here, const Vector2d& after, double radius) {
  const Vector2d in = (before - here).normalized();
  const Vector2d out = (after - here).normalized();
  const double half = std::acos(std::clamp(in.dot(out), -1.0, 1.0)) / 2;
  Piece piece;
  piece.radius = radius;
  piece.start = here + in * radius / std::tan(half);
  piece.end = here + out * radius / std::tan(half);
  piece.center = here + (in + out).normalized() * radius / std::sin(half);
  const Vector2d from = piece.start - piece.center;
  const Vector2d to = piece.end - piece.center;
  piece.first_angle = std::atan2(from.y(), from.x());
  piece.sweep = std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
  return piece;
}

PlaneCurve curve_of(std::vector<Piece> pieces, bool is_closed, int least) {
  PlaneCurve curve;
  curve.axis.is_closed = is_closed;
  for (const Piece& piece : pieces) {
    const bool is_arc = piece.radius > 0;
    const int least_arc = 1 + static_cast<int>(std::abs(piece.sweep) / 1.6);
    curve.axis.spans.push_back(
        {is_arc ? piece.radius * std::abs(piece.sweep) : (piece.end - piece.start).norm(), is_arc ? least_arc : least});
  }
  curve.point = [pieces = std::move(pieces)](double s) {
    const auto i = std::min(pieces.size() - 1, static_cast<std::size_t>(s));
    return pieces[i].at(s - static_cast<double>(i));
  };
  return curve;
}

/// The greatest distance of the curve from the origin.
double reach(const PlaneCurve& curve) {
  double radius = 0;
  for (std::size_t i = 0; i < curve.axis.spans.size(); ++i) {
    radius = std::max(radius, curve.point(static_cast<double>(i) + 0.5).norm());
  }
  return radius;
}

Axis scaled(Axis axis, double factor) {
  for (Span& span : axis.spans) {
    span.length *= factor;
  }
  return axis;
}

Vector3d raised(const Vector2d& point, double z) {
  return {point.x(), point.y(), z};
}

/// The border of a tile as seen from its hole.
PlaneCurve border(const Tile& tile) {
  const Vector2d low = tile.low - tile.hole;
  const Vector2d high = tile.high - tile.hole;
  return rounded_path({{low.x(), low.y()}, {high.x(), low.y()}, {high.x(), high.y()}, {low.x(), high.y()}}, true, 2);
}

}  // namespace

PlaneCurve rounded_path(const std::vector<Corner>& corners, bool is_closed, int least) {
  const std::size_t n = corners.size();
  const auto at = [&](std::size_t i) { return Vector2d(corners[i % n].x, corners[i % n].y); };
  // First the arcs (or sharp points), then the straight pieces between them.
  std::vector<Piece> turns;
  for (std::size_t i = 0; i < n; ++i) {
    const bool is_end = !is_closed && (i == 0 || i + 1 == n);
    const bool is_sharp = is_end || corners[i].radius == 0;
    turns.push_back(is_sharp ? Piece{at(i), at(i)} : arc(at(i + n - 1), at(i), at(i + 1), corners[i].radius));
  }
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < n; ++i) {
    if (turns[i].radius > 0) pieces.push_back(turns[i]);
    if (!is_closed && i + 1 == n) break;
    const Piece straight{turns[i].end, turns[(i + 1) % n].start};
    // Arcs may meet without a straight piece between them.
    if ((straight.end - straight.start).norm() > 1e-9) pieces.push_back(straight);
  }
  return curve_of(std::move(pieces), is_closed, least);
}

PlaneCurve rectangle(const Vector2d& size, double corner_radius, int least) {
  const double x = size.x() / 2;
  const double y = size.y() / 2;
  const double r = corner_radius;
  return rounded_path({{-x, -y, r}, {x, -y, r}, {x, y, r}, {-x, y, r}}, true, least);
}

PlaneCurve circle(double radius, int least) {
  return {{{{2 * pi * radius, least}}, true},
          [radius](double s) -> Vector2d { return radius * Vector2d(std::cos(2 * pi * s), std::sin(2 * pi * s)); }};
}

PlaneCurve gear_outline(double root_radius, double tip_radius, int teeth) {
  std::vector<Corner> corners;
  for (int i = 0; i < teeth; ++i) {
    const auto corner = [&](double part, double radius) {
      const double angle = 2 * pi * (i + part) / teeth;
      corners.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    };
    corner(0.0, root_radius);
    corner(0.4, root_radius);
    corner(0.6, tip_radius);
    corner(0.8, tip_radius);
  }
  return rounded_path(corners, true);
}

void add_turned(PatchWork& work, const PlaneCurve& outline, const PlaneCurve& profile) {
  const double radius = reach(outline);
  const double end = static_cast<double>(profile.axis.spans.size());
  double widest = 0;
  Axis v = profile.axis;
  for (std::size_t i = 0; i < v.spans.size(); ++i) {
    const auto s = static_cast<double>(i);
    const Vector2d a = profile.point(s);
    const Vector2d b = profile.point(v.is_closed && s + 1 == end ? 0 : s + 1);
    widest = std::max({widest, a.x(), b.x()});
    const double chord = (b - a).norm();
    if (chord > 0) v.spans[i].length *= std::hypot((b - a).x() * radius, (b - a).y()) / chord;
  }
  const bool is_open = !v.is_closed;
  const PatchWork::Poles poles{is_open && profile.point(0).x() == 0, is_open && profile.point(end).x() == 0};
  work.add(
      scaled(outline.axis, widest), std::move(v),
      [outline = outline.point, profile = profile.point](double u, double s) {
        const Vector2d p = profile(s);
        return raised(outline(u) * p.x(), p.y());
      },
      poles);
}

void add_revolution(PatchWork& work, const PlaneCurve& profile, int least_around) {
  add_turned(work, circle(1, least_around), profile);
}

void add_prism(PatchWork& work, const PlaneCurve& outline, double low, double high) {
  add_turned(work, outline, rounded_path({{0, low}, {1, low}, {1, high}, {0, high}}, false));
}

void add_pierced_prism(PatchWork& work, const PlaneCurve& outline, double hole_radius, double low, double high) {
  const double width = reach(outline) - hole_radius;
  const Axis v{{{width}, {high - low}, {width}, {high - low}}, true};
  work.add(outline.axis, v, [outline = outline.point, hole_radius, low, high](double u, double s) {
    const Vector2d outer = outline(u);
    const Vector2d inner = hole_radius * outer.normalized();
    if (s < 1) return raised(inner + s * (outer - inner), low);
    if (s < 2) return raised(outer, low + (s - 1) * (high - low));
    if (s < 3) return raised(outer + (s - 2) * (inner - outer), high);
    return raised(inner, high + (s - 3) * (low - high));
  });
}

void add_box(PatchWork& work, const Vector3d& size) {
  add_prism(work, rectangle(size.head<2>(), 0), -size.z() / 2, size.z() / 2);
}

void add_tiles(PatchWork& work, const std::vector<Tile>& tiles, double z) {
  for (const Tile& tile : tiles) {
    if (tile.hole_radius > 0) {
      const PlaneCurve outer = border(tile);
      const double width = (tile.high - tile.low).norm() / 2 - tile.hole_radius;
      work.add(outer.axis, {{{width}}}, [tile, outer = outer.point, z](double u, double v) {
        const Vector2d at = outer(u);
        const Vector2d inner = tile.hole_radius * at.normalized();
        return raised(tile.hole + inner + v * (at - inner), z);
      });
    } else {
      const Vector2d size = tile.high - tile.low;
      work.add({{{size.x()}}}, {{{size.y()}}},
               [tile, size, z](double u, double v) { return raised(tile.low + size.cwiseProduct(Vector2d(u, v)), z); });
    }
  }
}

void add_tiled_plate(PatchWork& work, const std::vector<Tile>& tiles, double low, double high) {
  add_tiles(work, tiles, low);
  add_tiles(work, tiles, high);
  for (const Tile& tile : tiles) {
    if (tile.hole_radius == 0) continue;
    const PlaneCurve outer = border(tile);
    work.add(outer.axis, {{{high - low}}}, [tile, outer = outer.point, low, high](double u, double v) {
      return raised(tile.hole + tile.hole_radius * outer(u).normalized(), low + v * (high - low));
    });
  }
}

void add_wall(PatchWork& work, const PlaneCurve& curve, double low, double high) {
  work.add(curve.axis, {{{high - low}}},
           [curve = curve.point, low, high](double u, double v) { return raised(curve(u), low + v * (high - low)); });
}

Spine::Spine(const std::function<Vector3d(double)>& curve, int samples) {
  for (int i = 0; i <= samples; ++i) {
    positions_.push_back(curve(static_cast<double>(i) / samples));
    const Vector3d step = i == 0 ? Vector3d::Zero() : Vector3d(positions_.back() - *(positions_.end() - 2));
    arc_.push_back(i == 0 ? 0 : arc_.back() + step.norm());
  }
  const std::size_t last = positions_.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const Vector3d along = (positions_[std::min(i + 1, last)] - positions_[i == 0 ? 0 : i - 1]).normalized();
    // The samples are close to each other, so the projection of the previous frame approximates parallel transport.
    const Vector3d before = i == 0 ? Vector3d(along.unitOrthogonal()) : first_.back();
    first_.push_back((before - before.dot(along) * along).normalized());
    second_.push_back(along.cross(first_.back()));
  }
}

Vector3d Spine::point(double t, const Vector2d& across) const {
  const double s = std::clamp(t, 0.0, 1.0) * length();
  const auto above = std::upper_bound(arc_.begin() + 1, arc_.end() - 1, s);
  const auto i = static_cast<std::size_t>(above - arc_.begin());
  const double part = (s - arc_[i - 1]) / (arc_[i] - arc_[i - 1]);
  const auto between = [&](const std::vector<Vector3d>& values) -> Vector3d {
    return values[i - 1] + part * (values[i] - values[i - 1]);
  };
  return between(positions_) + across.x() * between(first_) + across.y() * between(second_);
}

void add_wire(PatchWork& work, const std::shared_ptr<const Spine>& spine, double radius, int least_around,
              int least_along) {
  const PlaneCurve section = circle(radius, least_around);
  const Axis v{{{radius}, {spine->length(), least_along}, {radius}}};
  work.add(section.axis, v,
           [spine, section = section.point](double u, double s) {
             const double scale = std::clamp(std::min(s, 3 - s), 0.0, 1.0);
             return spine->point(s - 1, scale * section(u));
           },
           {true, true});
}

PatchWork::Map moved(const Eigen::Isometry3d& X_AB) {
  return [X_AB](const Vector3d& p) -> Vector3d { return X_AB * p; };
}

PatchWork::Map shifted(double x, double y, double z) {
  return [p = Vector3d(x, y, z)](const Vector3d& point) -> Vector3d { return point + p; };
}

PatchWork::Map turned(double angle, const Vector3d& axis, const Vector3d& p) {
  return moved(Eigen::Translation3d(p) * Eigen::AngleAxisd(angle, axis));
}

}  // namespace glissade::shapes
