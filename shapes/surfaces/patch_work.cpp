#include "surfaces/patch_work.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include <glissade/base/require.h>

namespace glissade::shapes {
namespace {

int cells(const Span& span, double edge) {
  return std::max(span.least, static_cast<int>(std::lround(span.length / edge)));
}

std::int64_t cells(const Axis& axis, double edge) {
  std::int64_t sum = 0;
  for (const Span& span : axis.spans) {
    sum += cells(span, edge);
  }
  return sum;
}

}  // namespace

void PatchWork::add(Axis u, Axis v, Surface surface, Poles poles) {
  // Every patch has another fineness: patches of equal size do not gain a row at the same edge length, so that counts
  // grow evenly, and no two faces look alike, as in a CAD model. Multiples of the golden ratio spread most evenly.
  constexpr double kGoldenRatio = 0.6180339887498949;
  const double turn = kGoldenRatio * static_cast<double>(patches_.size());
  const double fineness = 0.85 + 0.3 * (turn - std::floor(turn));
  patches_.push_back({std::move(u), std::move(v), std::move(surface), poles, fineness});
}

void PatchWork::add(const PatchWork& part, const Map& map, double fineness) {
  for (const Patch& patch : part.patches_) {
    patches_.push_back(patch);
    patches_.back().fineness *= fineness;
    patches_.back().surface = [surface = patch.surface, map](double u, double v) { return map(surface(u, v)); };
  }
}

std::int64_t PatchWork::count(double edge) const {
  std::int64_t sum = 0;
  for (const Patch& patch : patches_) {
    const std::int64_t cells_u = cells(patch.u, edge / patch.fineness);
    const std::int64_t cells_v = cells(patch.v, edge / patch.fineness);
    sum += 2 * cells_u * cells_v - cells_u * ((patch.poles.is_first ? 1 : 0) + (patch.poles.is_last ? 1 : 0));
  }
  return sum;
}

geometry::TriangleMesh PatchWork::tessellated(std::int64_t triangle_count) const {
  base::require_triangle_count(triangle_count);
  // Bisection on the logarithm of the edge length: the count does not increase with the edge length.
  double fine = 1e-6;
  double coarse = 100;
  for (int i = 0; i < 60; ++i) {
    const double edge = std::sqrt(fine * coarse);
    (count(edge) > triangle_count ? fine : coarse) = edge;
  }
  const bool is_fine_nearer = count(fine) - triangle_count < triangle_count - count(coarse);
  const double edge = is_fine_nearer ? fine : coarse;
  geometry::TriangleMesh mesh;
  mesh.triangles.reserve(static_cast<std::size_t>(count(edge)));
  for (const Patch& patch : patches_) {
    append(patch, edge / patch.fineness, mesh);
  }
  return mesh;
}

/// The parameters of the lines across `axis`.
std::vector<double> PatchWork::lines(const Axis& axis, double edge) {
  std::vector<double> parameters;
  for (std::size_t span = 0; span < axis.spans.size(); ++span) {
    const int count = cells(axis.spans[span], edge);
    for (int i = 0; i < count; ++i) {
      parameters.push_back(static_cast<double>(span) + static_cast<double>(i) / count);
    }
  }
  if (!axis.is_closed) parameters.push_back(static_cast<double>(axis.spans.size()));
  return parameters;
}

void PatchWork::append(const Patch& patch, double edge, geometry::TriangleMesh& mesh) {
  const std::vector<double> us = lines(patch.u, edge);
  const std::vector<double> vs = lines(patch.v, edge);
  const auto width = static_cast<std::int32_t>(us.size());
  const auto height = static_cast<std::int32_t>(vs.size());
  const auto is_pole = [&](std::int32_t row) {
    return (row == 0 && patch.poles.is_first) || (row == height - 1 && patch.poles.is_last);
  };
  std::vector<std::int32_t> row_start;
  for (std::int32_t row = 0; row < height; ++row) {
    row_start.push_back(static_cast<std::int32_t>(mesh.vertices.size()));
    for (std::int32_t i = 0; i < (is_pole(row) ? 1 : width); ++i) {
      mesh.vertices.push_back(patch.surface(us[static_cast<std::size_t>(i)], vs[static_cast<std::size_t>(row)]));
    }
  }
  const std::int32_t cells_u = patch.u.is_closed ? width : width - 1;
  const std::int32_t cells_v = patch.v.is_closed ? height : height - 1;
  for (std::int32_t row = 0; row < cells_v; ++row) {
    const std::int32_t next_row = (row + 1) % height;
    const std::int32_t low = row_start[static_cast<std::size_t>(row)];
    const std::int32_t high = row_start[static_cast<std::size_t>(next_row)];
    for (std::int32_t i = 0; i < cells_u; ++i) {
      const std::int32_t j = (i + 1) % width;
      if (is_pole(row)) {
        mesh.triangles.push_back({low, high + j, high + i});
      } else if (is_pole(next_row)) {
        mesh.triangles.push_back({low + i, low + j, high});
      } else {
        mesh.triangles.push_back({low + i, low + j, high + j});
        mesh.triangles.push_back({low + i, high + j, high + i});
      }
    }
  }
}

}  // namespace glissade::shapes
