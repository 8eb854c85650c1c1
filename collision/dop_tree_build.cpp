#include "dop_tree_build.h"

#include <algorithm>
#include <array>
#include <limits>

#include <Eigen/Geometry>

#include "round_up.h"

namespace glissade::collision {
namespace {

constexpr int kLargestLeaf = 2;
constexpr int kBins = 16;

/// A run of triangles that becomes one node.
struct Run {
  std::int32_t node;
  std::int32_t begin;
  std::int32_t end;
  int depth;
};

struct Bin {
  Eigen::AlignedBox3d box;
  std::int32_t count = 0;
};

double half_area(const Eigen::AlignedBox3d& box) {
  if (box.isEmpty()) return 0.0;
  const Eigen::Vector3d size = box.sizes();
  return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
}

class Builder {
 public:
  Builder(const TriangleMesh& mesh, std::vector<std::int32_t>& triangles, std::vector<DopNode>& nodes)
      : mesh_(mesh), triangles_(triangles), nodes_(nodes) {
    boxes_.resize(mesh.triangles.size());
    for (const std::int32_t t : triangles) {
      for (int c = 0; c < 3; ++c)
        boxes_[static_cast<std::size_t>(t)].extend(mesh.corner(t, c));
    }
  }

  int build() {
    nodes_.clear();
    nodes_.reserve(triangles_.size());
    nodes_.emplace_back();
    std::vector<Run> open{{0, 0, static_cast<std::int32_t>(triangles_.size()), 0}};
    int depth = 0;
    while (!open.empty()) {
      const Run run = open.back();
      open.pop_back();
      depth = std::max(depth, run.depth);
      DopNode& node = nodes_[static_cast<std::size_t>(run.node)];
      if (run.end - run.begin <= kLargestLeaf) {
        node.first = run.begin;
        node.count = run.end - run.begin;
        continue;
      }
      const std::int32_t middle = split(run);
      const auto child = static_cast<std::int32_t>(nodes_.size());
      node.first = child;
      node.count = 0;
      nodes_.resize(nodes_.size() + 2);
      open.push_back({child + 1, middle, run.end, run.depth + 1});
      open.push_back({child, run.begin, middle, run.depth + 1});
    }
    nodes_.shrink_to_fit();
    enclose_all();
    return depth;
  }

 private:
  Eigen::Vector3d centroid(std::int32_t triangle) const { return boxes_[static_cast<std::size_t>(triangle)].center(); }

  /// Reorders the run so that its two halves are [begin, result) and [result, end), neither empty.
  std::int32_t split(const Run& run) {
    Eigen::AlignedBox3d centroids;
    for (std::int32_t i = run.begin; i < run.end; ++i)
      centroids.extend(centroid(triangles_[static_cast<std::size_t>(i)]));

    double best_cost = std::numeric_limits<double>::infinity();
    int best_axis = -1;
    int best_bin = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(centroids.sizes()[axis] > 0.0)) continue;
      const auto [cost, bin] = best_split_on_axis(run, centroids, axis);
      if (cost < best_cost) {
        best_cost = cost;
        best_axis = axis;
        best_bin = bin;
      }
    }

    const auto first = triangles_.begin() + run.begin;
    const auto last = triangles_.begin() + run.end;
    if (best_axis >= 0) {
      const auto middle = std::stable_partition(
          first, last, [&](std::int32_t t) { return bin_of(centroid(t), centroids, best_axis) <= best_bin; });
      if (middle != first && middle != last) return static_cast<std::int32_t>(middle - triangles_.begin());
    }
    return run.begin + (run.end - run.begin) / 2;  // all centroids in one place: any split is as good
  }

  static int bin_of(const Eigen::Vector3d& centroid, const Eigen::AlignedBox3d& centroids, int axis) {
    const double position = (centroid[axis] - centroids.min()[axis]) / centroids.sizes()[axis];
    return std::clamp(static_cast<int>(position * kBins), 0, kBins - 1);
  }

  /// The surface-area cost of the best of the kBins − 1 splits of an axis, and the last bin of its lower side.
  std::pair<double, int> best_split_on_axis(const Run& run, const Eigen::AlignedBox3d& centroids, int axis) const {
    std::array<Bin, kBins> bins;
    for (std::int32_t i = run.begin; i < run.end; ++i) {
      const std::int32_t t = triangles_[static_cast<std::size_t>(i)];
      Bin& bin = bins[static_cast<std::size_t>(bin_of(centroid(t), centroids, axis))];
      bin.box.extend(boxes_[static_cast<std::size_t>(t)]);
      ++bin.count;
    }

    std::array<double, kBins> cost_above{};  // of bins i + 1 and up
    Bin above;
    for (int i = kBins - 1; i > 0; --i) {
      const Bin& bin = bins[static_cast<std::size_t>(i)];
      above.box.extend(bin.box);
      above.count += bin.count;
      cost_above[static_cast<std::size_t>(i - 1)] = half_area(above.box) * above.count;
    }

    std::pair<double, int> best{std::numeric_limits<double>::infinity(), 0};
    Bin below;
    for (int i = 0; i + 1 < kBins; ++i) {
      const Bin& bin = bins[static_cast<std::size_t>(i)];
      below.box.extend(bin.box);
      below.count += bin.count;
      if (below.count == 0 || below.count == run.end - run.begin) continue;
      const double cost = half_area(below.box) * below.count + cost_above[static_cast<std::size_t>(i)];
      if (cost < best.first) best = {cost, i};
    }
    return best;
  }

  /// Children follow their parents in the array, so one backward pass sees them first.
  void enclose_all() {
    for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node) {
      if (node->is_leaf()) {
        enclose_triangles(*node);
      } else {
        const Dop& left = nodes_[static_cast<std::size_t>(node->first)].dop;
        const Dop& right = nodes_[static_cast<std::size_t>(node->first) + 1].dop;
        for (std::size_t i = 0; i < kDopDirections; ++i) {
          node->dop.support[i] = std::max(left.support[i], right.support[i]);
        }
      }
    }
  }

  void enclose_triangles(DopNode& leaf) const {
    for (int i = 0; i < kDopDirections; ++i) {
      double support = -std::numeric_limits<double>::infinity();
      for (std::int32_t entry = leaf.first; entry < leaf.first + leaf.count; ++entry) {
        for (int c = 0; c < 3; ++c) {
          const Eigen::Vector3d& corner = mesh_.corner(triangles_[static_cast<std::size_t>(entry)], c);
          support = std::max(support, dop_direction(i).dot(corner));
        }
      }
      leaf.dop.support[static_cast<std::size_t>(i)] = round_up_to_float(support);
    }
  }

  const TriangleMesh& mesh_;
  std::vector<std::int32_t>& triangles_;
  std::vector<DopNode>& nodes_;
  std::vector<Eigen::AlignedBox3d> boxes_;
};

}  // namespace

int build_nodes(const TriangleMesh& mesh, std::vector<std::int32_t>& triangles, std::vector<DopNode>& nodes) {
  return Builder(mesh, triangles, nodes).build();
}

}  // namespace glissade::collision
