// Compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/distance_bounds.cpp"
#include "kernels/distance_bounds.h"

#include <algorithm>
#include <cmath>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "kernels/pair_lanes-inl.h"
#include "kernels/round_up.h"
#include "tree/dop.h"
#include "tree/generic_dop.h"

HWY_BEFORE_NAMESPACE();
namespace glissade::collision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr float kOrigin[3] = {0.0F, 0.0F, 0.0F};

using ReachTag = hn::FixedTag<float, kWidth>;

// All offsets of four children: [quarter line][child].
struct alignas(64) Offsets {
  float value[8 * slab_lines(kMostSlabs)][kWidth];
};

HWY_INLINE void to_floats(const SlabLine* node, int slabs, Offsets& offsets) {
  const hn::CappedTag<float, 16> d;
  const hn::RebindToSigned<decltype(d)> d32;
  const hn::Rebind<std::int16_t, decltype(d)> d16;
  const std::int16_t* const lanes = node->rows[0].above.data();
  const std::size_t count = 32 * static_cast<std::size_t>(slab_lines(slabs));
  for (std::size_t i = 0; i < count; i += hn::Lanes(d))
    hn::Store(hn::ConvertTo(d, hn::PromoteTo(d32, hn::Load(d16, lanes + i))), d, &offsets.value[0][0] + i);
}

// The intervals of four children along the three directions of a frame.
struct alignas(64) Intervals {
  float low[3][kWidth];
  float high[3][kWidth];
};

HWY_INLINE void reach(const std::array<ReachAlong, 3>& along, const Offsets& offsets, const float* origin,
                      Intervals& intervals) {
  const ReachTag d;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const ReachAlong& terms = along[axis];
    const auto side = [&](std::size_t opposite) HWY_ATTR {
      auto sum = hn::Set(d, terms.padding);
      for (std::size_t term = 0; term < 3; ++term) {
        sum = hn::Add(
            hn::Mul(hn::Set(d, terms.weight[term]), hn::Load(d, offsets.value[terms.quarter[term] ^ opposite])), sum);
      }
      return sum;
    };
    const auto start = hn::Set(d, origin[axis]);
    hn::Store(hn::Add(start, side(0)), d, intervals.high[axis]);
    hn::Store(hn::Sub(start, side(1)), d, intervals.low[axis]);
  }
}

// Along the first direction a child reaches no farther than its thin slab and its sphere. Close to where a curved
// surface is nearest, its normal is about this direction, and the slab is much tighter than any box (see thin_slab.h).
HWY_INLINE void clip_first(const BoundedNode& node, const std::array<float, 3>& direction, float scale, float padding,
                           float origin, Intervals& intervals) {
  const ReachTag d;
  const hn::FixedTag<std::int16_t, kWidth> d16;
  const hn::FixedTag<std::int32_t, kWidth> d32;
  using Four = hn::Vec<ReachTag>;
  const auto floats = [&](const FourValues& values)
                          HWY_ATTR { return hn::ConvertTo(d, hn::PromoteTo(d32, hn::Load(d16, values.data()))); };
  Four cosine = hn::Zero(d);
  Four center = hn::Zero(d);
  Four normal[3];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto along = hn::Set(d, direction[axis]);
    normal[axis] = hn::Mul(floats(node.head.normal[axis]), hn::Set(d, 1.0F / 32767.0F));
    cosine = hn::Add(hn::Mul(normal[axis], along), cosine);
    const SlabRow& row = node.slabs->rows[axis];
    center = hn::Add(hn::Mul(hn::Sub(floats(row.above), floats(row.below)), hn::Mul(along, hn::Set(d, 0.5F))), center);
  }
  Four chord = hn::Zero(d);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto turned = hn::Xor(hn::Set(d, direction[axis]), hn::And(hn::SignBit(d), cosine));
    const auto difference = hn::Sub(normal[axis], turned);
    chord = hn::Add(hn::Mul(difference, difference), chord);
  }
  const auto radius = floats(node.head.radius);
  const auto tilt = hn::Add(hn::Mul(radius, hn::Add(hn::Sqrt(chord), hn::Set(d, 3e-4F))),
                            hn::Mul(floats(node.head.half_width), hn::Abs(cosine)));
  const auto middle = hn::Add(hn::Mul(floats(node.head.offset), cosine), center);
  const auto high = hn::Min(hn::Add(middle, tilt), hn::Add(center, radius));
  const auto low = hn::Max(hn::Sub(middle, tilt), hn::Sub(center, radius));
  const auto start = hn::Set(d, origin);
  const auto certain_high = hn::Add(start, hn::Add(hn::Mul(hn::Set(d, scale), high), hn::Set(d, padding)));
  const auto certain_low = hn::Add(start, hn::Sub(hn::Mul(hn::Set(d, scale), low), hn::Set(d, padding)));
  hn::Store(hn::Min(certain_high, hn::Load(d, intervals.high[0])), d, intervals.high[0]);
  hn::Store(hn::Max(certain_low, hn::Load(d, intervals.low[0])), d, intervals.low[0]);
}

HWY_INLINE void clip(const BoxFrame& frame, const BoundedNode& node_M, const BoundedNode& node_N, Intervals& of_node_M,
                     Intervals& of_node_N) {
  clip_first(node_M, frame.first_M, 1.0F, frame.of_M[0].padding, 0.0F, of_node_M);
  clip_first(node_N, frame.first_N, frame.scale_N, frame.of_N[0].padding, frame.between[0], of_node_N);
}

void bound_all(const std::array<BoxFrame, kBoxFrames>& frames, const BoundedNode& node_M, const BoundedNode& node_N,
               int slabs, DistanceBounds& bounds) {
  const hn::CappedTag<float, kPairs> d;
  Offsets offsets_M;
  Offsets offsets_N;
  to_floats(node_M.slabs, slabs, offsets_M);
  to_floats(node_N.slabs, slabs, offsets_N);
  std::array<Intervals, kBoxFrames> of_node_M;
  std::array<Intervals, kBoxFrames> of_node_N;
  for (std::size_t f = 0; f < kBoxFrames; ++f) {
    reach(frames[f].of_M, offsets_M, kOrigin, of_node_M[f]);
    reach(frames[f].of_N, offsets_N, frames[f].between.data(), of_node_N[f]);
  }
  clip(frames.back(), node_M, node_N, of_node_M.back(), of_node_N.back());
  // Rounded down: the root of a sum of three squares.
  const auto scale = hn::Set(d, 0.999999F / static_cast<float>(kGridRadius));
  for (std::size_t first = 0; first < kPairs; first += hn::Lanes(d)) {
    auto square = hn::Zero(d);
    auto greatest = hn::Set(d, -1e30F);
    for (std::size_t f = 0; f < kBoxFrames; ++f) {
      auto sum = hn::Zero(d);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto gap = hn::Max(hn::Sub(of_N(d, of_node_N[f].low[axis]), of_M(d, of_node_M[f].high[axis], first)),
                                 hn::Sub(of_M(d, of_node_M[f].low[axis], first), of_N(d, of_node_N[f].high[axis])));
        greatest = hn::Max(greatest, gap);
        const auto apart = hn::Max(gap, hn::Zero(d));
        sum = hn::Add(hn::Mul(apart, apart), sum);
      }
      square = hn::Max(square, sum);
    }
    const auto bound = hn::IfThenElse(hn::Gt(greatest, hn::Zero(d)), hn::Sqrt(square), greatest);
    hn::Store(hn::Mul(bound, scale), d, bounds.bound.data() + first);
  }
}

void bound_first(const BoxFrame& frame, const BoundedNode& node_M, const BoundedNode& node_N, int slabs,
                 DistanceBounds& bounds) {
  const hn::CappedTag<float, kPairs> d;
  Offsets offsets_M;
  Offsets offsets_N;
  to_floats(node_M.slabs, slabs, offsets_M);
  to_floats(node_N.slabs, slabs, offsets_N);
  Intervals of_node_M;
  Intervals of_node_N;
  reach(frame.of_M, offsets_M, kOrigin, of_node_M);
  reach(frame.of_N, offsets_N, frame.between.data(), of_node_N);
  clip(frame, node_M, node_N, of_node_M, of_node_N);
  for (std::size_t first = 0; first < kPairs; first += hn::Lanes(d)) {
    const auto gap = hn::Sub(of_N(d, of_node_N.low[0]), of_M(d, of_node_M.high[0], first));
    hn::Store(hn::Mul(gap, hn::Set(d, 1.0F / static_cast<float>(kGridRadius))), d, bounds.bound.data() + first);
  }
}

}  // namespace glissade::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glissade::collision {
namespace {

HWY_EXPORT(bound_all);
HWY_EXPORT(bound_first);

using Eigen::Vector3d;

// The three half-spaces at the vertex of the generic DOP that is extremal in this direction. Rounded weights that are
// not negative bound a direction that differs a little; points lie within the grid's radius and its rounding.
ReachAlong reach_along(int k, const Vector3d& direction, double scale) {
  const DopDirections& directions = dop_directions(k);
  const GenericVertex* extremal = nullptr;
  double most = -1.0;
  for (const GenericVertex& vertex : generic_dop_vertices(k)) {
    const double projection = std::abs(vertex.position.dot(direction));
    if (projection > most) {
      most = projection;
      extremal = &vertex;
    }
  }
  const double sign = extremal->position.dot(direction) < 0.0 ? -1.0 : 1.0;
  const Vector3d weights = extremal->weights_of_direction * (sign * direction);
  ReachAlong along{};
  Vector3d bounded = Vector3d::Zero();
  double sum = 0.0;
  for (std::size_t term = 0; term < 3; ++term) {
    const int own = extremal->half_spaces[term];
    const int half_space = sign > 0.0 ? own : directions.opposite(own);
    const bool is_above = half_space < directions.slabs;
    along.quarter[term] =
        static_cast<std::uint8_t>(is_above ? 2 * half_space : 2 * (half_space - directions.slabs) + 1);
    along.weight[term] = static_cast<float>(scale * std::max(0.0, weights[static_cast<Eigen::Index>(term)]));
    const auto weight = static_cast<double>(along.weight[term]);
    bounded += weight * directions.half_space(half_space);
    sum += weight;
  }
  // Each of the three sums is rounded once, relative to values of at most the weighted offsets.
  constexpr double kReach = kGridRadius + 1.0;
  along.padding = round_up_to_float(kReach * ((bounded - scale * direction).norm() + 0x1p-22 * sum));
  return along;
}

}  // namespace

BoxFrame box_frame(int k, const QueryFrame& frame, const Eigen::Matrix3d& axes, double nearer) {
  BoxFrame box;
  const Vector3d first_M = axes.col(0);
  const Vector3d first_N = frame.R_MN.transpose() * first_M;
  for (int axis = 0; axis < 3; ++axis) {
    box.first_M[static_cast<std::size_t>(axis)] = static_cast<float>(first_M[axis]);
    box.first_N[static_cast<std::size_t>(axis)] = static_cast<float>(first_N[axis]);
  }
  box.scale_N = static_cast<float>(frame.ratio);
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const Vector3d direction = axes.col(axis);
    const double between = direction.dot(frame.p_MN) - (axis == 0 ? nearer : 0.0);
    box.of_M[i] = reach_along(k, direction, 1.0);
    box.of_N[i] = reach_along(k, frame.R_MN.transpose() * direction, frame.ratio);
    box.between[i] = static_cast<float>(kGridRadius * between);
    // Rounding of `between`, of the reach added to it, and of the result by its last factor; the direction's length,
    // the sum in double precision, and the points of the query.
    const double rounding = 0x1p-21 * (1.0 + frame.ratio + std::abs(between)) +
                            1e-15 * (1.0 + frame.ratio + frame.p_MN.norm()) + 4.0 * frame.uncertainty;
    box.of_M[i].padding += static_cast<float>(kGridRadius * rounding);
  }
  return box;
}

void bound_distances(const std::array<BoxFrame, kBoxFrames>& frames, const BoundedNode& node_M,
                     const BoundedNode& node_N, int slabs, DistanceBounds& bounds) {
  HWY_DYNAMIC_DISPATCH(bound_all)(frames, node_M, node_N, slabs, bounds);
}

void bound_along(const BoxFrame& frame, const BoundedNode& node_M, const BoundedNode& node_N, int slabs,
                 DistanceBounds& bounds) {
  HWY_DYNAMIC_DISPATCH(bound_first)(frame, node_M, node_N, slabs, bounds);
}

}  // namespace glissade::collision
#endif
