#include "tree/dop_tree_build.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <span>

#include <Eigen/Core>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_group.h>

namespace glissade::collision {
namespace {

constexpr std::size_t kBins = 32;
constexpr std::size_t kSweepAtMost = 64;  // up to this many triangles are sorted rather than binned

// Number of triangles that is worth a task of its own. The thread sanitizer does not see how oneTBB hands over tasks,
// and would report a race for every triangle.
#if defined(__SANITIZE_THREAD__)
#define GLISSADE_THREAD_SANITIZER
#elif defined(__has_feature)  // clang's equivalent
#if __has_feature(thread_sanitizer)
#define GLISSADE_THREAD_SANITIZER
#endif
#endif
#ifdef GLISSADE_THREAD_SANITIZER
constexpr std::size_t kTaskAtLeast = std::numeric_limits<std::size_t>::max();
#else
constexpr std::size_t kTaskAtLeast = 4'096;
#endif

struct Box {
  Eigen::Array3f low = Eigen::Array3f::Constant(std::numeric_limits<float>::infinity());
  Eigen::Array3f high = -low;

  void extend(const Box& other) {
    low = low.min(other.low);
    high = high.max(other.high);
  }
  float half_area() const {
    const Eigen::Array3f size = (high - low).max(0.0F);
    return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
  }
};

struct Item {
  Box box;
  std::int32_t triangle;

  /// Twice the centre of the box.
  float center(int axis) const { return box.low[axis] + box.high[axis]; }
};
using Items = std::span<Item>;

// A split before item `at`. It applies once items are in the order of the sweep, or on the sides of the bins, that it
// was found for.
struct Split {
  float cost = std::numeric_limits<float>::infinity();
  int axis = -1;
  std::size_t at = 0;  // of the sweep: an item; of the bins: the first bin of the upper side
};

// The cost of visiting that number of triangles: its leaves, and a node for each four leaves.
float cost_of(std::size_t triangles) {
  const std::size_t leaves = (triangles + kWidth - 1) / kWidth;
  const std::size_t nodes = (leaves + kWidth - 1) / kWidth;
  return static_cast<float>(leaves + nodes);
}

Box box_of(Items items) {
  Box box;
  for (const Item& item : items)
    box.extend(item.box);
  return box;
}

void sort_along(Items items, int axis) {
  std::sort(items.begin(), items.end(), [axis](const Item& u, const Item& v) {
    const float cu = u.center(axis);
    const float cv = v.center(axis);
    return cu != cv ? cu < cv : u.triangle < v.triangle;
  });
}

// Finds the best split of few items, at multiples of a leaf so that leaves are full.
std::size_t split_by_sweep(Items items) {
  std::array<float, kSweepAtMost + 1> area_above{};
  Split best;
  for (int axis = 0; axis < 3; ++axis) {
    sort_along(items, axis);
    Box above;
    for (std::size_t i = items.size(); i-- > 1;) {
      above.extend(items[i].box);
      area_above[i] = above.half_area();
    }
    Box below;
    for (std::size_t i = 1; i < items.size(); ++i) {
      below.extend(items[i - 1].box);
      if (i % kWidth != 0) continue;
      const float cost = below.half_area() * cost_of(i) + area_above[i] * cost_of(items.size() - i);
      if (cost < best.cost) best = {cost, axis, i};
    }
  }
  if (best.axis != 2) sort_along(items, best.axis);
  return best.at;
}

struct Bin {
  Box box;
  std::size_t count = 0;
};

class Binning {
 public:
  explicit Binning(Items items) {
    low_.setConstant(std::numeric_limits<float>::infinity());
    Eigen::Array3f high = -low_;
    for (const Item& item : items) {
      const Eigen::Array3f center = item.box.low + item.box.high;
      low_ = low_.min(center);
      high = high.max(center);
    }
    const Eigen::Array3f scale = static_cast<float>(kBins) * 0.9999F / (high - low_);
    // If all centres coincide, or nearly so, they get one bin.
    scale_ = scale.isFinite().select(scale, 0.0F);
    for (const Item& item : items) {
      const Eigen::Array3f center = item.box.low + item.box.high;
      for (int axis = 0; axis < 3; ++axis) {
        Bin& bin = bins_[static_cast<std::size_t>(axis)][bin_of(center[axis], axis)];
        bin.box.extend(item.box);
        ++bin.count;
      }
    }
  }

  std::size_t bin_of(float center, int axis) const {
    return std::min(static_cast<std::size_t>((center - low_[axis]) * scale_[axis]), kBins - 1);
  }

  Split best_split() const {
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
      const auto& bins = bins_[static_cast<std::size_t>(axis)];
      std::array<float, kBins> cost_above{};
      Bin above;
      for (std::size_t i = kBins; i-- > 1;) {
        add(bins[i], above);
        cost_above[i] = above.count == 0 ? 0.0F : above.box.half_area() * cost_of(above.count);
      }
      const std::size_t total = above.count + bins[0].count;
      Bin below;
      for (std::size_t i = 1; i < kBins; ++i) {
        add(bins[i - 1], below);
        if (below.count == 0 || below.count == total) continue;
        const float cost = below.box.half_area() * cost_of(below.count) + cost_above[i];
        if (cost < best.cost) best = {cost, axis, i};
      }
    }
    return best;
  }

 private:
  static void add(const Bin& bin, Bin& sum) {
    sum.box.extend(bin.box);
    sum.count += bin.count;
  }

  Eigen::Array3f low_;
  Eigen::Array3f scale_;
  std::array<std::array<Bin, kBins>, 3> bins_;
};

// Puts the items of one side before those of the other and returns the index of the first of the latter.
std::size_t split(Items items) {
  if (items.size() <= kSweepAtMost) return split_by_sweep(items);
  const Binning binning(items);
  const Split best = binning.best_split();
  if (best.axis < 0) return items.size() / 2 / kWidth * kWidth;  // all centres in one place: any split is as good
  const auto middle = std::partition(items.begin(), items.end(), [&](const Item& item) {
    return binning.bin_of(item.center(best.axis), best.axis) < best.at;
  });
  return static_cast<std::size_t>(middle - items.begin());
}

// A future node, before nodes have numbers.
struct Part {
  Items items;
  std::array<std::unique_ptr<Part>, kWidth> children;
  int child_count = 0;

  bool is_leaf() const { return items.size() <= kWidth; }
};

// Splits the part of largest surface until there are four, then divides each of these.
void divide(Part& part) {
  std::array<Items, kWidth> pieces{part.items};
  std::array<float, kWidth> areas{box_of(part.items).half_area()};
  std::size_t count = 1;
  while (count < kWidth) {
    std::size_t largest = kWidth;
    for (std::size_t i = 0; i < count; ++i) {
      if (pieces[i].size() > kWidth && (largest == kWidth || areas[i] > areas[largest])) largest = i;
    }
    if (largest == kWidth) break;
    const Items whole = pieces[largest];
    const std::size_t at = split(whole);
    pieces[largest] = whole.first(at);
    pieces[count] = whole.subspan(at);
    areas[largest] = box_of(pieces[largest]).half_area();
    areas[count] = box_of(pieces[count]).half_area();
    ++count;
  }

  tbb::task_group tasks;
  for (std::size_t i = 0; i < count; ++i) {
    part.children[i] = std::make_unique<Part>();
    Part& child = *part.children[i];
    child.items = pieces[i];
    if (child.is_leaf()) continue;
    if (child.items.size() >= kTaskAtLeast) {
      tasks.run([&child] { divide(child); });
    } else {
      divide(child);
    }
  }
  part.child_count = static_cast<int>(count);
  tasks.wait();
}

TriangleLeaf leaf_of(Items items) {
  TriangleLeaf leaf{};
  leaf.triangle.fill(kNoTriangle);
  for (std::size_t i = 0; i < items.size(); ++i)
    leaf.triangle[i] = items[i].triangle;
  return leaf;
}

// Numbers the parts in depth-first order, with the children of a node side by side.
void number(const Part& part, std::size_t node, int depth, TreeShape& shape) {
  shape.depth = std::max(shape.depth, depth);
  std::array<const Part*, kWidth> inner{};
  std::size_t inner_count = 0;
  NodeHead head{};
  head.first_leaf = static_cast<std::uint32_t>(shape.leaves.size());
  for (int c = 0; c < part.child_count; ++c) {
    const Part& child = *part.children[static_cast<std::size_t>(c)];
    if (child.is_leaf()) {
      shape.leaves.push_back(leaf_of(child.items));
      ++head.leaf_count;
    } else {
      inner[inner_count++] = &child;
    }
  }
  head.node_count = static_cast<std::uint8_t>(inner_count);
  head.first_node = static_cast<std::uint32_t>(shape.nodes.size());
  shape.nodes[node] = head;
  shape.nodes.resize(shape.nodes.size() + inner_count);
  for (std::size_t i = 0; i < inner_count; ++i)
    number(*inner[i], head.first_node + i, depth + 1, shape);
}

}  // namespace

TreeShape build_shape(const geometry::TriangleMesh& mesh) {
  std::vector<Item> items(mesh.triangles.size());
  const auto measure = [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t t = range.begin(); t < range.end(); ++t) {
      items[t].triangle = static_cast<std::int32_t>(t);
      for (int c = 0; c < 3; ++c) {
        const Eigen::Array3f corner = mesh.corner(items[t].triangle, c).cast<float>().array();
        items[t].box.extend({corner, corner});
      }
    }
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, items.size(), kTaskAtLeast), measure);

  Part root;
  root.items = items;
  divide(root);

  TreeShape shape;
  shape.leaves.reserve(items.size() / 3);
  shape.nodes.resize(1);
  number(root, 0, 0, shape);
  shape.nodes.shrink_to_fit();
  shape.leaves.shrink_to_fit();
  return shape;
}

}  // namespace glissade::collision
