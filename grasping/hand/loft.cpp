#include "hand/loft.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace glissade::grasping {
namespace {

using Eigen::Vector3d;

/// Sections of a cap, as angles from its flat side.
constexpr std::array<double, 2> kCapAngles{std::numbers::pi / 6, std::numbers::pi / 3};

/// The section of a cap of length `cap`, which is negative before the first section.
LoftSection cap_section(const LoftSection& s, double cap, double angle) {
  const double scale = std::cos(angle);
  return {s.x + cap * std::sin(angle), s.y, s.z, scale * s.width, scale * s.up, scale * s.down};
}

std::vector<LoftSection> with_caps(const std::vector<LoftSection>& sections, double start_cap, double end_cap) {
  std::vector<LoftSection> all;
  for (auto angle = kCapAngles.rbegin(); angle != kCapAngles.rend(); ++angle)
    all.push_back(cap_section(sections.front(), -start_cap, *angle));
  all.insert(all.end(), sections.begin(), sections.end());
  for (const double angle : kCapAngles)
    all.push_back(cap_section(sections.back(), end_cap, angle));
  return all;
}

double signed_power(double base, double exponent) {
  return std::copysign(std::pow(std::abs(base), exponent), base);
}

void add_ring(const LoftSection& s, double corner, int around, std::vector<Vector3d>& vertices) {
  for (int i = 0; i < around; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / around;
    const double across = signed_power(std::cos(angle), 2.0 / corner);
    const double height = signed_power(std::sin(angle), 2.0 / corner);
    vertices.emplace_back(s.x, s.y + s.width * across, s.z + (height > 0 ? s.up : s.down) * height);
  }
}

}  // namespace

geometry::TriangleMesh loft(const std::vector<LoftSection>& sections, double start_cap, double end_cap, double corner,
                            int around) {
  const LoftSection& first = sections.front();
  const LoftSection& last = sections.back();
  geometry::TriangleMesh mesh;
  mesh.vertices.emplace_back(first.x - start_cap, first.y, first.z);
  mesh.vertices.emplace_back(last.x + end_cap, last.y, last.z);
  const std::vector<LoftSection> rings = with_caps(sections, start_cap, end_cap);
  for (const LoftSection& ring : rings)
    add_ring(ring, corner, around, mesh.vertices);
  const auto vertex = [&](std::size_t ring, int i) {
    return static_cast<std::int32_t>(2 + static_cast<int>(ring) * around + i % around);
  };
  for (int i = 0; i < around; ++i) {
    mesh.triangles.push_back({0, vertex(0, i + 1), vertex(0, i)});
    for (std::size_t ring = 0; ring + 1 < rings.size(); ++ring) {
      mesh.triangles.push_back({vertex(ring, i), vertex(ring, i + 1), vertex(ring + 1, i + 1)});
      mesh.triangles.push_back({vertex(ring, i), vertex(ring + 1, i + 1), vertex(ring + 1, i)});
    }
    mesh.triangles.push_back({1, vertex(rings.size() - 1, i), vertex(rings.size() - 1, i + 1)});
  }
  return mesh;
}

}  // namespace glissade::grasping
