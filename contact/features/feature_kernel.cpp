// Compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "features/feature_kernel.cpp"
#include "features/feature_kernel.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace glissade::contact::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Coordinates are relative to a corner of the obstacle's triangle, and divided by the greatest of them. They are
// rounded by half of 2^-24, and by less than that in double precision if the greatest exceeds kLeastSize of the
// coordinates of the bodies.
constexpr double kLeastSize = 1e-7;
// Along a unit vector, the difference of two projections then errs by less than 32 · 2^-24, and its division by the
// length of a vector by a few units of the last place.
constexpr float kSlack = 1e-5F;
// The squares of shorter vectors may underflow.
constexpr float kLeastSquare = 1e-30F;
// The cross product c of edges d and e errs by less than 70 · 2^-24, and so does e × c by 172 · 2^-24 |e|, and the
// product of that with the difference of two corners by 1024 · 2^-24 |e|, or twice that for the other end of d; the
// same with d and e exchanged.
constexpr float kSlackOfEnds = 2e-4F;
// The length of a vector is less than 3.5, so that its product with c errs by less than 250 · 2^-24. Divided by the
// length of c, which errs as much, it errs by less than 500 · 2^-24 over that length.
constexpr float kSlackOfNormal = 5e-5F;
constexpr float kFarAway = 1e30F;

using Tag = hn::CappedTag<float, kTrianglePairs>;
using V = hn::Vec<Tag>;

struct Vector3 {
  V x;
  V y;
  V z;
};
struct Triangle {
  Vector3 corner[3];
  Vector3 edge[3];
};

HWY_INLINE Vector3 minus(const Vector3& a, const Vector3& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Vector3 cross(const Vector3& a, const Vector3& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
HWY_INLINE V dot(const Vector3& a, const Vector3& b) {
  return hn::Add(hn::Mul(a.x, b.x), hn::Add(hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)));
}

// All pairs in units of their own size.
struct alignas(64) ScaledPairs {
  float obstacle[3][3][kTrianglePairs];  // [corner][axis][pair]
  float part[3][3][kTrianglePairs];
  float reach[kTrianglePairs];
  float past_end[kTrianglePairs];
  float margin[kTrianglePairs];
  float size[kTrianglePairs];  // metres
};

HWY_INLINE void scale(const TrianglePairs& pairs, const RelativePose& X_OV, const ContactReach& reach,
                      ScaledPairs& scaled) {
  const hn::CappedTag<double, kTrianglePairs> d;
  const hn::Rebind<float, decltype(d)> df;
  for (std::size_t first = 0; first < kTrianglePairs; first += hn::Lanes(d)) {
    hn::Vec<decltype(d)> obstacle[3][3];
    hn::Vec<decltype(d)> part[3][3];
    auto size = hn::Zero(d);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto origin = hn::Load(d, pairs.p_O[0][axis].data() + first);
      const auto& R = X_OV.R_OV[axis];
      for (std::size_t c = 0; c < 3; ++c) {
        obstacle[c][axis] = hn::Sub(hn::Load(d, pairs.p_O[c][axis].data() + first), origin);
        const auto in_V = [&](std::size_t a) HWY_ATTR { return hn::Load(d, pairs.p_V[c][a].data() + first); };
        const auto in_O = hn::Add(hn::Mul(in_V(0), hn::Set(d, R[0])),
                                  hn::Add(hn::Mul(in_V(1), hn::Set(d, R[1])),
                                          hn::Add(hn::Mul(in_V(2), hn::Set(d, R[2])), hn::Set(d, X_OV.p_OV[axis]))));
        part[c][axis] = hn::Sub(in_O, origin);
        size = hn::Max(size, hn::Max(hn::Abs(obstacle[c][axis]), hn::Abs(part[c][axis])));
      }
    }
    const auto is_known = hn::Gt(size, hn::Set(d, kLeastSize * reach.coordinates));
    const auto factor = hn::IfThenElseZero(is_known, hn::Div(hn::Set(d, 1.0), size));
    const auto store = [&](hn::Vec<decltype(d)> value, float* to)
                           HWY_ATTR { hn::Store(hn::DemoteTo(df, value), df, to + first); };
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        store(hn::Mul(obstacle[c][axis], factor), scaled.obstacle[c][axis]);
        store(hn::Mul(part[c][axis], factor), scaled.part[c][axis]);
      }
    }
    const auto in_sizes = [&](double length) HWY_ATTR {
      const auto far_away = hn::Set(d, static_cast<double>(kFarAway));
      return hn::IfThenElse(is_known, hn::Min(hn::Mul(hn::Set(d, 1.000001 * length), factor), far_away), far_away);
    };
    store(in_sizes(reach.reach + reach.past_end), scaled.reach);
    store(in_sizes(reach.past_end), scaled.past_end);
    store(in_sizes(reach.margin), scaled.margin);
    store(hn::IfThenElseZero(is_known, size), scaled.size);
  }
}

HWY_INLINE Triangle load(const float (&corners)[3][3][kTrianglePairs], std::size_t first) {
  const Tag d;
  Triangle t;
  for (std::size_t c = 0; c < 3; ++c) {
    t.corner[c] = {hn::Load(d, corners[c][0] + first), hn::Load(d, corners[c][1] + first),
                   hn::Load(d, corners[c][2] + first)};
  }
  for (std::size_t c = 0; c < 3; ++c)
    t.edge[c] = minus(t.corner[(c + 1) % 3], t.corner[c]);
  return t;
}

HWY_INLINE V not_negative(V x) {
  return hn::Max(x, hn::Zero(Tag()));
}

// 1 over the length of a vector with this square; 0 for a vector that is too short.
HWY_INLINE V inverse_root(V square) {
  const Tag d;
  return hn::IfThenElseZero(hn::Ge(square, hn::Set(d, kLeastSquare)), hn::Div(hn::Set(d, 1.0F), hn::Sqrt(square)));
}

// Raises the lower bounds of the distances of three points from a triangle by the gaps along n, whatever its error.
HWY_INLINE void raise_along(const Vector3& n, const Triangle& t, const Vector3 (&points)[3], V (&gaps)[3]) {
  const Tag d;
  const V inverse_length = inverse_root(dot(n, n));
  const V h0 = dot(n, t.corner[0]);
  const V h1 = dot(n, t.corner[1]);
  const V h2 = dot(n, t.corner[2]);
  const V low = hn::Min(h0, hn::Min(h1, h2));
  const V high = hn::Max(h0, hn::Max(h1, h2));
  for (std::size_t i = 0; i < 3; ++i) {
    const V h = dot(n, points[i]);
    const V beyond = hn::Max(hn::Sub(low, h), hn::Sub(h, high));
    gaps[i] = hn::Max(gaps[i], hn::Sub(hn::Mul(beyond, inverse_length), hn::Set(d, kSlack)));
  }
}

// Lower bounds of the distances of three points from a triangle: along its normal and across its edges.
HWY_INLINE void find_gaps(const Triangle& t, const Vector3 (&points)[3], V (&gaps)[3]) {
  const Vector3 normal = cross(t.edge[0], t.edge[1]);
  for (V& gap : gaps)
    gap = hn::Zero(Tag());
  raise_along(normal, t, points, gaps);
  for (std::size_t i = 0; i < 3; ++i)
    raise_along(cross(normal, t.edge[i]), t, points, gaps);
}

// Two edges at one moment.
struct EdgePair {
  V gap;      // a lower bound of their distance
  V outside;  // one of the closest points of their lines lies at least so far outside its edge; 0: that is not certain
  V nearer;   // the opposite corner of one of the triangles is nearer by at least so much along the normal; 0: as above
};

// How far the interval from h to h + rise lies on one side of 0; negative if 0 is inside.
HWY_INLINE V beyond_zero(V h, V rise) {
  const V other = hn::Add(h, rise);
  return hn::Max(hn::Min(h, other), hn::Neg(hn::Max(h, other)));
}

// An edge, from its first corner.
struct Edge {
  Vector3 along;
  Vector3 to_opposite;  // corner of its triangle
  V inverse_length;
};

HWY_INLINE Edge edge_of(const Triangle& t, std::size_t i) {
  return {t.edge[i], minus(t.corner[(i + 2) % 3], t.corner[i]), inverse_root(dot(t.edge[i], t.edge[i]))};
}

// Edges of the part and the obstacle, whose first corners differ by `between` (from the obstacle to the part).
HWY_INLINE EdgePair look_at_edges(const Edge& of_part, const Edge& of_obstacle, const Vector3& between) {
  const Vector3& d = of_part.along;
  const Vector3& e = of_obstacle.along;
  const Tag tag;
  const V zero = hn::Zero(tag);
  const Vector3 c = cross(d, e);
  const V inverse_c = inverse_root(dot(c, c));
  const V h = dot(c, between);
  const V h_end = hn::Add(h, dot(c, d));
  const V along_e = dot(c, e);
  const V along_c =
      hn::Max(hn::Sub(hn::Min(h, h_end), hn::Max(zero, along_e)), hn::Sub(hn::Min(zero, along_e), hn::Max(h, h_end)));
  // The plane through e along c has both ends of d on one side, or that through d those of e.
  const Vector3 u = cross(e, c);
  const Vector3 v = cross(d, c);
  const V across_e = hn::Mul(beyond_zero(dot(u, between), dot(u, d)), of_obstacle.inverse_length);
  const V across_d = hn::Mul(beyond_zero(hn::Neg(dot(v, between)), dot(v, e)), of_part.inverse_length);
  const V across = hn::Sub(hn::Max(across_d, across_e), hn::Set(tag, kSlackOfEnds));
  const V outside = not_negative(hn::Mul(across, inverse_c));
  // The normal is c or its opposite, as far as it is certain on which side the part is.
  const V slack = hn::Add(hn::Mul(hn::Set(tag, kSlackOfNormal), inverse_c), hn::Set(tag, kSlack));
  const V side = hn::Mul(h, inverse_c);
  const V below_part = hn::Neg(dot(c, of_part.to_opposite));
  const V above_obstacle = dot(c, of_obstacle.to_opposite);
  const V along_normal = hn::Mul(hn::IfThenElse(hn::Lt(h, zero), hn::Max(hn::Neg(below_part), hn::Neg(above_obstacle)),
                                                hn::Max(below_part, above_obstacle)),
                                 inverse_c);
  const V nearer = hn::IfThenElseZero(hn::Gt(hn::Abs(side), slack), not_negative(hn::Sub(along_normal, slack)));
  return {hn::Max(outside, hn::Sub(hn::Mul(along_c, inverse_c), hn::Set(tag, kSlack))), outside, nearer};
}

// The features of as many pairs as fit into a vector.
class Look {
 public:
  HWY_INLINE Look(const ScaledPairs& scaled, PossibleContacts& possible, std::size_t first)
      : obstacle_(load(scaled.obstacle, first)),
        part_(load(scaled.part, first)),
        reach_(hn::Load(Tag(), scaled.reach + first)),
        past_end_(hn::Load(Tag(), scaled.past_end + first)),
        margin_(hn::Load(Tag(), scaled.margin + first)),
        size_(hn::Load(Tag(), scaled.size + first)),
        counting_(hn::Load(Bits(), possible.features.data() + first)),
        left_(counting_),
        not_nearest_(hn::Zero(Bits())),
        least_(hn::Set(Tag(), kFarAway)),
        least_beyond_(least_),
        least_left_out_(least_) {}

  HWY_INLINE void at_corners() {
    V gaps[3];
    find_gaps(obstacle_, part_.corner, gaps);
    for (int i = 0; i < 3; ++i)
      note(with_part_corner(i), gaps[i], never());
    find_gaps(part_, obstacle_.corner, gaps);
    for (int i = 0; i < 3; ++i)
      note(with_obstacle_corner(i), gaps[i], never());
  }

  HWY_INLINE void at_edges() {
    Edge of_obstacle[3];
    for (std::size_t j = 0; j < 3; ++j)
      of_obstacle[j] = edge_of(obstacle_, j);
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge of_part = edge_of(part_, i);
      for (std::size_t j = 0; j < 3; ++j) {
        const EdgePair pair = look_at_edges(of_part, of_obstacle[j], minus(part_.corner[i], obstacle_.corner[j]));
        const FeaturePairs feature = with_edges(static_cast<int>(i), static_cast<int>(j));
        note(feature, pair.gap, hn::Gt(pair.outside, past_end_));
        const auto is_not_nearest = hn::RebindMask(Bits(), hn::Gt(pair.nearer, margin_));
        not_nearest_ = hn::Or(not_nearest_, hn::IfThenElseZero(is_not_nearest, hn::Set(Bits(), feature)));
      }
    }
  }

  HWY_INLINE void store(PossibleContacts& possible, std::size_t first) const {
    hn::Store(left_, Bits(), possible.features.data() + first);
    hn::Store(hn::AndNot(not_nearest_, left_), Bits(), possible.nearest.data() + first);
    hn::Store(hn::Mul(least_, size_), Tag(), possible.gaps.data() + first);
    hn::Store(hn::Mul(least_beyond_, size_), Tag(), possible.gaps_beyond.data() + first);
    hn::Store(hn::Mul(least_left_out_, size_), Tag(), possible.gaps_left_out.data() + first);
  }

 private:
  using Bits = hn::RebindToUnsigned<Tag>;

  HWY_INLINE static hn::Mask<Tag> never() { return hn::FirstN(Tag(), 0); }

  // A pair of features is left out that is beyond reach, and one that is no contact at any distance.
  HWY_INLINE void note(FeaturePairs feature, V gap, hn::Mask<Tag> is_none) {
    const Bits bits;
    const auto bit = hn::Set(bits, feature);
    const auto is_beyond = hn::Gt(gap, reach_);
    const auto is_left_out = hn::Or(is_beyond, is_none);
    left_ = hn::AndNot(hn::IfThenElseZero(hn::RebindMask(bits, is_left_out), bit), left_);
    const auto counts = hn::RebindMask(Tag(), hn::TestBit(counting_, bit));
    least_ = hn::IfThenElse(counts, hn::Min(least_, gap), least_);
    const auto may_come = hn::And(counts, hn::AndNot(is_none, is_beyond));
    least_beyond_ = hn::IfThenElse(may_come, hn::Min(least_beyond_, gap), least_beyond_);
    least_left_out_ = hn::IfThenElse(hn::And(counts, is_left_out), hn::Min(least_left_out_, gap), least_left_out_);
  }

  Triangle obstacle_;
  Triangle part_;
  V reach_;
  V past_end_;
  V margin_;
  V size_;
  hn::Vec<Bits> counting_;
  hn::Vec<Bits> left_;
  hn::Vec<Bits> not_nearest_;
  V least_;
  V least_beyond_;
  V least_left_out_;
};

void leave_out_impossible(const TrianglePairs& pairs, const RelativePose& X_OV, const ContactReach& reach,
                          PossibleContacts& possible) {
  ScaledPairs scaled;
  scale(pairs, X_OV, reach, scaled);
  for (std::size_t first = 0; first < kTrianglePairs; first += hn::Lanes(Tag())) {
    Look look(scaled, possible, first);
    look.at_corners();
    look.at_edges();
    look.store(possible, first);
  }
}

}  // namespace glissade::contact::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glissade::contact {
namespace {

HWY_EXPORT(leave_out_impossible);

}  // namespace

void leave_out_impossible(const TrianglePairs& pairs, const RelativePose& X_OV, const ContactReach& reach,
                          PossibleContacts& possible) {
  HWY_DYNAMIC_DISPATCH(leave_out_impossible)(pairs, X_OV, reach, possible);
}

}  // namespace glissade::contact
#endif
