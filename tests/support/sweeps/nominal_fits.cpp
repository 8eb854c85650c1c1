#include "sweeps/nominal_fits.h"

#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/LU>

#include <glissade/geometry/mesh_generators.h>

#include "poses.h"

namespace glissade::test_support {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::TriangleMesh;

const Vector3d kX = Vector3d::UnitX();
const Vector3d kY = Vector3d::UnitY();
const Vector3d kZ = Vector3d::UnitZ();

/// Counterclockwise.
using Outline = std::vector<Vector2d>;

/// From z = bottom to z = top.
struct Extent {
  double bottom;
  double top;
};

Outline rectangle(double left, double right, double low, double high) {
  return {{left, low}, {right, low}, {right, high}, {left, high}};
}

Outline polygon(int corners, double radius) {
  Outline outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return outline;
}

/// With all sides moved inwards.
Outline smaller(const Outline& outline, double inwards) {
  Outline moved;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d before = (outline[i] - outline[(i + outline.size() - 1) % outline.size()]).normalized();
    const Vector2d after = (outline[(i + 1) % outline.size()] - outline[i]).normalized();
    Eigen::Matrix2d normals;
    normals << -before.y(), before.x(), -after.y(), after.x();
    moved.push_back(outline[i] + normals.inverse() * Vector2d(inwards, inwards));
  }
  return moved;
}

void add_walls(const Outline& outline, const Extent& z, bool faces_out, TriangleMesh& mesh) {
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  const auto count = static_cast<std::int32_t>(outline.size());
  for (const Vector2d& p : outline) {
    mesh.vertices.emplace_back(p.x(), p.y(), z.bottom);
    mesh.vertices.emplace_back(p.x(), p.y(), z.top);
  }
  for (std::int32_t i = 0; i < count; ++i) {
    const std::int32_t a = first + 2 * i;
    const std::int32_t b = first + 2 * ((i + 1) % count);
    const std::int32_t c = faces_out ? b : a;
    const std::int32_t d = faces_out ? a : b;
    mesh.triangles.push_back({d, c, c + 1});
    mesh.triangles.push_back({d, c + 1, d + 1});
  }
}

/// A prism whose whole outline is seen from `middle_of`.
TriangleMesh prism(const Outline& outline, const Extent& z, const Vector2d& middle_of = Vector2d::Zero()) {
  TriangleMesh mesh;
  add_walls(outline, z, true, mesh);
  const auto middle = static_cast<std::int32_t>(mesh.vertices.size());
  mesh.vertices.emplace_back(middle_of.x(), middle_of.y(), z.bottom);
  mesh.vertices.emplace_back(middle_of.x(), middle_of.y(), z.top);
  for (std::int32_t a = 0; a < middle; a += 2) {
    const std::int32_t b = (a + 2) % middle;
    mesh.triangles.push_back({middle, b, a});
    mesh.triangles.push_back({middle + 1, a + 1, b + 1});
  }
  return mesh;
}

TriangleMesh convex_prism(const Outline& outline, const Extent& z) {
  Vector2d sum = Vector2d::Zero();
  for (const Vector2d& corner : outline)
    sum += corner;
  return prism(outline, z, sum / static_cast<double>(outline.size()));
}

/// A prism with a hole; both outlines have the same number of corners.
TriangleMesh ring(const Outline& outer, const Outline& inner, const Extent& z) {
  TriangleMesh mesh;
  add_walls(outer, z, true, mesh);
  add_walls(inner, z, false, mesh);
  const auto count = static_cast<std::int32_t>(2 * outer.size());
  for (std::int32_t a = 0; a < count; a += 2) {
    const std::int32_t b = (a + 2) % count;
    for (const auto& [p, q, r] : {geometry::Triangle{b, a, count + a}, geometry::Triangle{b, count + a, count + b}}) {
      mesh.triangles.push_back({p, q, r});
      mesh.triangles.push_back({q + 1, p + 1, r + 1});
    }
  }
  return mesh;
}

TriangleMesh block(const Vector3d& low, const Vector3d& high, int triangles = 12) {
  return geometry::transformed(geometry::make_box(high - low, triangles), pose(0.5 * (low + high)));
}

/// Boxes and prisms as functions of how far their faces are inside.
std::function<TriangleMesh(double)> block_part(const Vector3d& low, const Vector3d& high, int triangles = 12) {
  return [=](double inwards) {
    const Vector3d by = Vector3d::Constant(inwards);
    return block(low + by, high - by, triangles);
  };
}
std::function<TriangleMesh(double)> prism_part(const Outline& outline, const Extent& z) {
  return [=](double inwards) { return prism(smaller(outline, inwards), {z.bottom + inwards, z.top - inwards}); };
}
std::function<TriangleMesh(double)> ring_part(const Outline& outer, const Outline& inner, const Extent& z) {
  return [=](double inwards) {
    return ring(smaller(outer, inwards), smaller(inner, -inwards), {z.bottom + inwards, z.top - inwards});
  };
}

std::vector<Vector3d> all_around() {
  return {kX, -kX, kY, -kY, Vector3d(1.0, 1.0, 0.0).normalized()};
}

std::vector<NominalFit> guides() {
  const Outline dovetail{{-0.01, -0.005}, {0.01, -0.005}, {0.006, 0.005}, {-0.006, 0.005}};
  const Outline tee{{-0.004, -0.01}, {0.004, -0.01}, {0.004, -0.003}, {0.01, -0.003},
                    {0.01, 0.004},   {-0.01, 0.004}, {-0.01, -0.003}, {-0.004, -0.003}};
  return {
      {"peg in its sleeve",
       block_part({-0.01, -0.01, 0.0}, {0.01, 0.01, 0.06}),
       {ring(rectangle(-0.012, 0.012, -0.012, 0.012), rectangle(-0.01, 0.01, -0.01, 0.01), {0.0, 0.04})},
       0.07 * kZ,
       all_around()},
      {"slab between two blocks",
       block_part({-0.01, -0.01, 0.0}, {0.01, 0.01, 0.06}),
       {block({0.01, -0.05, 0.0}, {0.03, 0.05, 0.04}), block({-0.03, -0.05, 0.0}, {-0.01, 0.05, 0.04})},
       0.07 * kZ,
       {kX, -kX}},
      {"fine slab between two fine blocks",
       block_part({-0.01, -0.01, 0.0}, {0.01, 0.01, 0.06}, 300),
       {block({0.01, -0.05, 0.0}, {0.03, 0.05, 0.04}, 500), block({-0.03, -0.05, 0.0}, {-0.01, 0.05, 0.04}, 500)},
       0.07 * kZ,
       {kX, -kX}},
      {"dovetail",
       prism_part(dovetail, {0.0, 0.04}),
       {block({-0.02, -0.01, -0.01}, {0.02, -0.005, 0.05}),
        convex_prism({{0.01, -0.005}, {0.02, -0.005}, {0.02, 0.005}, {0.006, 0.005}}, {-0.01, 0.05}),
        convex_prism({{-0.006, 0.005}, {-0.02, 0.005}, {-0.02, -0.005}, {-0.01, -0.005}}, {-0.01, 0.05})},
       0.06 * kZ,
       {kX, -kX, kY, -kY}},
      {"tee in its slot",
       prism_part(tee, {0.0, 0.03}),
       {block({0.004, -0.012, 0.0}, {0.02, -0.003, 0.03}), block({-0.02, -0.012, 0.0}, {-0.004, -0.003, 0.03}),
        block({0.01, -0.003, 0.0}, {0.02, 0.004, 0.03}), block({-0.02, -0.003, 0.0}, {-0.01, 0.004, 0.03}),
        block({-0.02, 0.004, 0.0}, {0.02, 0.01, 0.03})},
       0.04 * kZ,
       {kX, -kX, kY, -kY}},
      {"drawer in its case",
       block_part({-0.02, -0.01, 0.0}, {0.02, 0.01, 0.05}),
       {block({-0.03, 0.01, 0.0}, {0.03, 0.015, 0.05}), block({-0.03, -0.015, 0.0}, {0.03, -0.01, 0.05}),
        block({0.02, -0.01, 0.0}, {0.03, 0.01, 0.05}), block({-0.03, -0.01, 0.0}, {-0.02, 0.01, 0.05}),
        block({-0.03, -0.015, -0.01}, {0.03, 0.015, 0.0})},
       0.06 * kZ,
       {kX, -kX, kY, -kY, -kZ}},
  };
}

std::vector<NominalFit> on_supports() {
  return {
      {"box on a table",
       block_part({-0.01, -0.01, 0.0}, {0.01, 0.01, 0.02}),
       {block({-0.2, -0.2, -0.02}, {0.2, 0.2, 0.0})},
       0.03 * Vector3d(1.0, 0.3, 0.5),
       {-kZ}},
      {"box pushed along a table",
       block_part({-0.01, -0.01, 0.0}, {0.01, 0.01, 0.02}),
       {block({-0.2, -0.2, -0.02}, {0.2, 0.2, 0.0}, 400)},
       Vector3d(0.03, 0.0, 0.001),
       {-kZ}},
      {"box on a sheet",
       block_part({-0.01, -0.01, 0.0}, {0.01, 0.01, 0.02}),
       {geometry::make_plate({0.4, 0.4}, 2)},
       0.02 * kZ,
       {-kZ}},
      {"stacked plates",
       block_part({-0.03, -0.02, 0.0}, {0.03, 0.02, 0.002}),
       {block({-0.03, -0.02, -0.002}, {0.03, 0.02, 0.0}), block({-0.03, -0.02, -0.004}, {0.03, 0.02, -0.002})},
       0.02 * kZ,
       {-kZ}},
      {"box in a corner",
       block_part({0.0, 0.0, 0.0}, {0.02, 0.03, 0.04}),
       {block({-0.01, -0.01, -0.01}, {0.0, 0.1, 0.1}), block({0.0, -0.01, 0.0}, {0.1, 0.0, 0.1}),
        block({0.0, -0.01, -0.01}, {0.1, 0.1, 0.0})},
       0.03 * Vector3d(1.0, 1.0, 1.0),
       {-kX, -kY, -kZ, Vector3d(-1.0, -1.0, -1.0).normalized()}},
      {"bar in a vee",
       prism_part({{0.0, -0.01}, {0.01, 0.0}, {0.0, 0.01}, {-0.01, 0.0}}, {0.0, 0.05}),
       {convex_prism({{0.0, -0.01}, {0.0, -0.02}, {0.02, -0.02}, {0.02, 0.01}}, {0.0, 0.05}),
        convex_prism({{0.0, -0.01}, {-0.02, 0.01}, {-0.02, -0.02}, {0.0, -0.02}}, {0.0, 0.05})},
       0.03 * kY,
       {-kY}},
  };
}

/// An open part: a sheet in the plane y = 0, from z = 0 upward. Its edges touch; inwards is away from them.
std::function<TriangleMesh(double)> sheet_part(double left, const Vector3d& inwards) {
  return [=](double depth) {
    const Vector3d p = depth * inwards;
    TriangleMesh mesh;
    for (const auto& [x, z] : {std::pair(left, 0.0), {0.03, 0.0}, {0.03, 0.03}, {left, 0.03}})
      mesh.vertices.push_back(p + Vector3d(x, 0.0, z));
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
  };
}

std::vector<NominalFit> of_sheets() {
  return {
      {"sheet on its edge",
       sheet_part(-0.03, kZ),
       {block({-0.2, -0.2, -0.02}, {0.2, 0.2, 0.0})},
       0.03 * Vector3d(1.0, 0.3, 0.5),
       {-kZ}},
      {"sheet on its edge on a sheet",
       sheet_part(-0.03, kZ),
       {geometry::make_plate({0.4, 0.4}, 2)},
       0.03 * Vector3d(1.0, 0.3, 0.5),
       {-kZ}},
      {"sheet in a corner",
       sheet_part(0.0, kX + kZ),
       {block({-0.02, -0.1, -0.01}, {0.0, 0.1, 0.1}), block({0.0, -0.1, -0.01}, {0.1, 0.1, 0.0})},
       0.03 * Vector3d(1.0, 0.3, 1.0),
       {-kZ, -kX}},
  };
}

std::vector<NominalFit> in_seats() {
  const Outline shaft{{0.0096, -0.003}, {0.0120, -0.003}, {0.0120, 0.003}, {0.0096, 0.003},
                      {0.0, 0.01},      {-0.01, 0.0},     {0.0, -0.01}};
  const Outline hub{{0.02, -0.01}, {0.025, -0.008}, {0.025, 0.008}, {0.02, 0.01},
                    {0.0, 0.02},   {-0.02, 0.0},    {0.0, -0.02}};
  std::vector<Vector3d> all_but_up = all_around();
  all_but_up.push_back(-kZ);
  return {
      {"key in its slot",
       block_part({-0.003, -0.01, 0.0}, {0.003, 0.01, 0.006}),
       {block({-0.02, -0.02, -0.01}, {0.02, 0.02, 0.0}), block({0.003, -0.02, 0.0}, {0.02, 0.02, 0.004}),
        block({-0.02, -0.02, 0.0}, {-0.003, 0.02, 0.004}), block({-0.003, 0.01, 0.0}, {0.003, 0.02, 0.004}),
        block({-0.003, -0.02, 0.0}, {0.003, -0.01, 0.004})},
       0.01 * kZ,
       all_but_up},
      {"bearing in its seat",
       ring_part(polygon(32, 0.015), polygon(32, 0.008), {0.0, 0.009}),
       {ring(polygon(32, 0.02), polygon(32, 0.015), {0.0, 0.009}),
        ring(polygon(32, 0.02), polygon(32, 0.012), {-0.004, 0.0})},
       0.015 * kZ,
       all_but_up},
      {"tube between tubes",
       ring_part(polygon(24, 0.012), polygon(24, 0.01), {0.0, 0.05}),
       {ring(polygon(24, 0.014), polygon(24, 0.012), {0.0, 0.03}), prism(polygon(24, 0.01), {0.0, 0.04})},
       0.06 * kZ,
       all_around()},
      {"hexagon in its socket",
       prism_part(polygon(6, 0.01), {0.0, 0.02}),
       {ring(polygon(6, 0.015), polygon(6, 0.01), {0.0, 0.012}), prism(polygon(6, 0.015), {-0.005, 0.0})},
       0.025 * kZ,
       all_but_up},
      {"keyed shaft in its hub",
       prism_part(shaft, {0.0, 0.05}),
       {ring(hub, shaft, {0.01, 0.03})},
       0.05 * kZ,
       all_around()},
  };
}

}  // namespace

const std::vector<NominalFit>& nominal_fits() {
  static const std::vector<NominalFit> fits = [] {
    std::vector<NominalFit> all = guides();
    for (std::vector<NominalFit> more : {on_supports(), of_sheets(), in_seats()}) {
      for (NominalFit& fit : more)
        all.push_back(std::move(fit));
    }
    return all;
  }();
  return fits;
}

}  // namespace glissade::test_support
