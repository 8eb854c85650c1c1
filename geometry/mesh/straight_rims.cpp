#include "mesh/straight_rims.h"

#include <algorithm>
#include <utility>

#include <Eigen/Geometry>

namespace glissade::geometry {
namespace {

constexpr double kStraight_m = 1e-7;  // the rounding error of single-precision vertices, and less than any margin
constexpr double kStraightSine = 1e-4;

class StraightRims {
 public:
  StraightRims(const TriangleMesh& mesh, std::span<const RimEdges> rims)
      : mesh_(mesh), rims_(rims), inside_(mesh.vertices.size()), seen_(mesh.vertices.size()) {
    for (std::size_t v = 0; v < inside_.size(); ++v)
      inside_[v] = continues_straight(static_cast<std::int32_t>(v)) ? 1 : 0;
  }

  std::vector<char> find() {
    // All lines are collected first: `keep_bends` changes the marks that `extend` follows.
    std::vector<std::vector<std::int32_t>> lines;
    for (std::size_t v = 0; v < inside_.size(); ++v) {
      if (inside_[v] != 0 && seen_[v] == 0) lines.push_back(line_through(static_cast<std::int32_t>(v)));
    }
    for (const std::vector<std::int32_t>& line : lines) {
      inside_[static_cast<std::size_t>(line.front())] = 0;  // matters for a ring only: its start becomes an end
      keep_bends(line);
    }
    return std::move(inside_);
  }

 private:
  const Eigen::Vector3d& point(std::int32_t v) const { return mesh_.vertices[static_cast<std::size_t>(v)]; }

  bool continues_straight(std::int32_t v) const {
    const RimEdges& rim = rims_[static_cast<std::size_t>(v)];
    if (rim.count != 2) return false;
    const Eigen::Vector3d in = point(v) - point(rim.to[0]);
    const Eigen::Vector3d out = point(rim.to[1]) - point(v);
    return in.dot(out) > 0.0 && in.cross(out).norm() <= kStraightSine * in.norm() * out.norm();
  }

  /// The vertices of the straight line through v, from one end to the other; of a ring, from v around to v.
  std::vector<std::int32_t> line_through(std::int32_t v) {
    std::vector<std::int32_t> line{v};
    seen_[static_cast<std::size_t>(v)] = 1;
    extend(line, rims_[static_cast<std::size_t>(v)].to[0]);
    if (line.back() == v) return line;
    std::reverse(line.begin(), line.end());
    extend(line, rims_[static_cast<std::size_t>(v)].to[1]);
    return line;
  }

  /// Appends `next` and its successors to a line, up to the first vertex that does not continue straight or was seen
  /// before.
  void extend(std::vector<std::int32_t>& line, std::int32_t next) {
    while (true) {
      const std::int32_t before = line.back();
      line.push_back(next);
      if (inside_[static_cast<std::size_t>(next)] == 0 || seen_[static_cast<std::size_t>(next)] != 0) return;
      seen_[static_cast<std::size_t>(next)] = 1;
      const std::array<std::int32_t, 2>& to = rims_[static_cast<std::size_t>(next)].to;
      next = to[0] == before ? to[1] : to[0];
    }
  }

  /// Splits a line at the vertex farthest from its chord, as long as that is too far away (Douglas–Peucker).
  void keep_bends(const std::vector<std::int32_t>& line) {
    std::vector<std::pair<std::size_t, std::size_t>> stretches{{0, line.size() - 1}};
    while (!stretches.empty()) {
      const auto [first, last] = stretches.back();
      stretches.pop_back();
      std::size_t farthest = first;
      double distance = kStraight_m;
      for (std::size_t i = first + 1; i < last; ++i) {
        const double d = distance_from_chord(point(line[i]), point(line[first]), point(line[last]));
        if (!(d > distance)) continue;
        distance = d;
        farthest = i;
      }
      if (farthest == first) continue;
      inside_[static_cast<std::size_t>(line[farthest])] = 0;
      stretches.push_back({first, farthest});
      stretches.push_back({farthest, last});
    }
  }

  static double distance_from_chord(const Eigen::Vector3d& x, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    const Eigen::Vector3d along = b - a;
    if (along.isZero(0.0)) return (x - a).norm();
    const double s = std::clamp(along.dot(x - a) / along.squaredNorm(), 0.0, 1.0);
    return (x - a - s * along).norm();
  }

  const TriangleMesh& mesh_;
  std::span<const RimEdges> rims_;
  std::vector<char> inside_;
  std::vector<char> seen_;
};

}  // namespace

std::vector<char> inside_straight_rims(const TriangleMesh& mesh, std::span<const RimEdges> rims) {
  return StraightRims(mesh, rims).find();
}

}  // namespace glissade::geometry
