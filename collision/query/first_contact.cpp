#include <array>
#include <cstdint>
#include <queue>
#include <stdexcept>
#include <string>
#include <vector>

#include <glissade/collision/dop_query.h>
#include <glissade/geometry/triangle_pair.h>

#include "kernels/query_frame.h"
#include "query/rigid_motion.h"

namespace glissade::collision {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using geometry::TrianglePoints;

/// A node, a leaf or a triangle of a tree.
struct Piece {
  enum class Kind : std::uint8_t { kNode, kLeaf, kTriangle };

  Kind kind;
  std::uint32_t number;
  const Obb* box;  // of its triangles; null for a triangle
};

/// Two pieces that are proven to be apart before a time.
struct PiecePair {
  double until;
  Piece piece_A;
  Piece piece_B;
  bool is_triangles() const { return piece_A.kind == Piece::Kind::kTriangle; }
};

struct IsLater {
  bool operator()(const PiecePair& a, const PiecePair& b) const { return a.until > b.until; }
};

/// The axes that may separate two boxes (Gottschalk, Lin and Manocha 1996), and the direction between their centres.
template <typename Look>
void for_each_axis(const Obb& box_A, const Matrix3d& axes_B_A, const Vector3d& between_A, const Look& look) {
  look(between_A);
  for (int i = 0; i < 3; ++i) {
    look(box_A.axes.col(i));
    look(axes_B_A.col(i));
    for (int j = 0; j < 3; ++j)
      look(box_A.axes.col(i).cross(axes_B_A.col(j)));
  }
}

/// The normals of both triangles, and the directions across an edge of each.
template <typename Look>
void for_each_axis(const TrianglePoints& a, const TrianglePoints& b, const Look& look) {
  std::array<Vector3d, 3> edges_a;
  std::array<Vector3d, 3> edges_b;
  for (std::size_t i = 0; i < 3; ++i) {
    edges_a[i] = a[(i + 1) % 3] - a[i];
    edges_b[i] = b[(i + 1) % 3] - b[i];
  }
  look(edges_a[0].cross(edges_a[1]));
  look(edges_b[0].cross(edges_b[1]));
  for (const Vector3d& edge_a : edges_a) {
    for (const Vector3d& edge_b : edges_b)
      look(edge_a.cross(edge_b));
  }
}

/// Calls `see` with the unit vector of a direction, if it has one.
template <typename See>
auto normalizing(const See& see) {
  return [&see](const Vector3d& direction) {
    const double length = direction.norm();
    if (length > 0.0) see(direction / length);
  };
}

class FirstContactSearch {
 public:
  FirstContactSearch(const DopTree& tree_A, const DopTree& tree_B, const RigidMotion& motion, double tolerance,
                     double target)
      : tree_A_(tree_A),
        tree_B_(tree_B),
        obbs_A_(tree_A.obb_tree()),
        obbs_B_(tree_B.obb_tree()),
        frame_(motion),
        speed_B_(frame_.speed((tree_B.center() - motion.p_Bref).norm() + tree_B.radius())),
        tolerance_(tolerance),
        target_(target) {}

  std::optional<FirstContact> run() {
    open_nodes(0.0, {Piece::Kind::kNode, 0, nullptr}, {Piece::Kind::kNode, 0, nullptr});
    while (!pairs_.empty()) {
      const PiecePair pair = pairs_.top();
      pairs_.pop();
      if (!pair.is_triangles()) {
        open(pair);
      } else if (std::optional<FirstContact> contact = examine_triangles(pair)) {
        return contact;
      }
    }
    return std::nullopt;
  }

 private:
  void push(double until, const Piece& piece_A, const Piece& piece_B) {
    if (until <= 1.0) pairs_.push({until, piece_A, piece_B});
  }

  static Piece child_of(const TreeNode& node, const ObbTree& boxes, std::uint32_t number, int child) {
    return {node.is_leaf(child) ? Piece::Kind::kLeaf : Piece::Kind::kNode, node.child(child),
            &boxes.box(number, child)};
  }

  /// Replaces the larger box by what it consists of.
  void open(const PiecePair& pair) {
    const auto& [until, piece_A, piece_B] = pair;
    const bool leaf_A = piece_A.kind == Piece::Kind::kLeaf;
    const bool leaf_B = piece_B.kind == Piece::Kind::kLeaf;
    if (leaf_A && leaf_B) return open_leaves(pair);
    if (leaf_B || (!leaf_A && piece_A.box->radius >= piece_B.box->radius)) {
      const TreeNode node = tree_A_.node(piece_A.number);
      for (int child = 0; child < node.child_count(); ++child)
        examine_boxes(until, child_of(node, *obbs_A_, piece_A.number, child), piece_B);
    } else {
      const TreeNode node = tree_B_.node(piece_B.number);
      for (int child = 0; child < node.child_count(); ++child)
        examine_boxes(until, piece_A, child_of(node, *obbs_B_, piece_B.number, child));
    }
  }

  void open_nodes(double until, const Piece& piece_A, const Piece& piece_B) {
    const TreeNode node_A = tree_A_.node(piece_A.number);
    const TreeNode node_B = tree_B_.node(piece_B.number);
    for (int a = 0; a < node_A.child_count(); ++a) {
      for (int b = 0; b < node_B.child_count(); ++b)
        examine_boxes(until, child_of(node_A, *obbs_A_, piece_A.number, a),
                      child_of(node_B, *obbs_B_, piece_B.number, b));
    }
  }

  void open_leaves(const PiecePair& pair) {
    for (const std::int32_t triangle_A : tree_A_.triangles_of_leaf(pair.piece_A.number)) {
      for (const std::int32_t triangle_B : tree_B_.triangles_of_leaf(pair.piece_B.number)) {
        if (triangle_A < 0 || triangle_B < 0) continue;
        push(pair.until, {Piece::Kind::kTriangle, static_cast<std::uint32_t>(triangle_A), nullptr},
             {Piece::Kind::kTriangle, static_cast<std::uint32_t>(triangle_B), nullptr});
      }
    }
  }

  /// Pushes the pair with the time from which boxes prove no more. A box that proves less than it takes to move by the
  /// size of the smaller one is too coarse.
  void examine_boxes(double from, const Piece& piece_A, const Piece& piece_B) {
    const Obb& box_A = *piece_A.box;
    const Obb& box_B = *piece_B.box;
    if (box_A.radius < 0.0 || box_B.radius < 0.0) return;
    double until = from;
    while (until <= 1.0) {
      const double step = time_apart(box_A, box_B, until);
      until += step;
      if (step * speed_B_ < std::min(box_A.radius, box_B.radius)) break;
    }
    push(until, piece_A, piece_B);
  }

  /// The longest time after `t` during which one direction proves two boxes apart.
  double time_apart(const Obb& box_A, const Obb& box_B, double t) const {
    const Eigen::Isometry3d X_AB = frame_.X_AB(t);
    const Vector3d from_ref_A = X_AB.linear() * (box_B.c - frame_.p_Bref());
    const Vector3d between_A = X_AB * box_B.c - box_A.c;
    const Matrix3d axes_B_A = X_AB.linear() * box_B.axes;
    const auto extent_B = [&](const Vector3d& n_A) {
      return std::min(box_B.half_size.dot((axes_B_A.transpose() * n_A).cwiseAbs()), box_B.radius * n_A.norm());
    };
    const double bend = frame_.acceleration(frame_.distance_from_axis(from_ref_A) + box_B.radius);
    double longest = 0.0;
    for_each_axis(box_A, axes_B_A, between_A, normalizing([&](const Vector3d& direction) {
                    const Vector3d n_A = direction.dot(between_A) < 0.0 ? Vector3d(-direction) : direction;
                    const double gap =
                        n_A.dot(between_A) - std::min(box_A.extent_along(n_A), box_A.radius) - extent_B(n_A);
                    const Vector3d turn_A = frame_.turn_along(n_A);
                    const double rate = n_A.dot(frame_.v_A()) + turn_A.dot(from_ref_A) - extent_B(turn_A);
                    longest = std::max(longest, Approach{gap, rate, bend}.time_above(target_));
                  }));
    return longest;
  }

  /// A contact, if the triangles are near enough now. Otherwise pushes the pair with a later time.
  std::optional<FirstContact> examine_triangles(const PiecePair& pair) {
    const Eigen::Isometry3d X_AB = frame_.X_AB(pair.until);
    const TrianglePair triangles{static_cast<std::int32_t>(pair.piece_A.number),
                                 static_cast<std::int32_t>(pair.piece_B.number)};
    const TrianglePoints a = tree_A_.mesh().corners(triangles.triangle_A);
    TrianglePoints b = tree_B_.mesh().corners(triangles.triangle_B);
    for (Vector3d& corner : b)
      corner = X_AB * corner;
    const Vector3d p_Aref = X_AB * frame_.p_Bref();
    double longest = 0.0;
    for_each_axis(a, b, normalizing([&](const Vector3d& direction) {
                    for (const Vector3d& n_A : {direction, Vector3d(-direction)})
                      longest = std::max(longest, time_apart(a, b, p_Aref, n_A));
                  }));
    if (longest * speed_B_ < tolerance_) {
      const geometry::TriangleDistance closest = geometry::triangle_distance(a, b);
      if (closest.distance <= tolerance_)
        return FirstContact{pair.until, {triangles, closest.distance, closest.p_a, closest.p_b}};
      longest = std::max(longest, time_apart(a, b, p_Aref, (closest.p_b - closest.p_a).normalized()));
    }
    push(pair.until + longest, pair.piece_A, pair.piece_B);
    return std::nullopt;
  }

  /// The time during which a direction from A to B proves two triangles apart.
  double time_apart(const TrianglePoints& a, const TrianglePoints& b, const Vector3d& p_Aref,
                    const Vector3d& n_A) const {
    const double end_of_a = std::max({n_A.dot(a[0]), n_A.dot(a[1]), n_A.dot(a[2])});
    const Vector3d turn_A = frame_.turn_along(n_A);
    double time = std::numeric_limits<double>::infinity();
    for (const Vector3d& corner : b) {
      const Vector3d from_ref_A = corner - p_Aref;
      const Approach approach{n_A.dot(corner) - end_of_a, n_A.dot(frame_.v_A()) + turn_A.dot(from_ref_A),
                              frame_.acceleration(frame_.distance_from_axis(from_ref_A))};
      time = std::min(time, approach.time_above(target_));
    }
    return time;
  }

  const DopTree& tree_A_;
  const DopTree& tree_B_;
  std::shared_ptr<const ObbTree> obbs_A_;
  std::shared_ptr<const ObbTree> obbs_B_;
  MovingFrame frame_;
  double speed_B_;  // of its fastest point, at most
  double tolerance_;
  double target_;
  std::priority_queue<PiecePair, std::vector<PiecePair>, IsLater> pairs_{};
};

constexpr double kEpsilonOfMotion = std::numeric_limits<double>::epsilon();

/// The greatest length that occurs in the sums of the search.
double greatest_length(const DopTree& tree_A, const DopTree& tree_B, const RigidMotion& motion) {
  return tree_A.center().norm() + tree_A.radius() + (tree_B.center() - motion.p_Bref).norm() + tree_B.radius() +
         motion.p_Bref.norm() + (motion.X_AB_begin * motion.p_Bref).norm() + (motion.X_AB_end * motion.p_Bref).norm();
}

void check_motion(const DopTree& tree_A, const DopTree& tree_B, const RigidMotion& motion) {
  for (const Eigen::Isometry3d* X_AB : {&motion.X_AB_begin, &motion.X_AB_end}) {
    if (!(QueryFrame(tree_A, tree_B, *X_AB).rotation_defect <= 1e-9))
      throw std::invalid_argument("the matrices of a motion must be rotations to nine digits");
  }
  if (!(motion.p_Bref.lpNorm<1>() <= 1e12))
    throw std::invalid_argument("the reference point of a motion is not finite or too far away");
}

}  // namespace

Eigen::Isometry3d RigidMotion::X_AB(double t) const {
  return MovingFrame(*this).X_AB(t);
}

std::optional<FirstContact> first_contact(const DopTree& tree_A, const DopTree& tree_B, const RigidMotion& motion,
                                          double tolerance) {
  check_motion(tree_A, tree_B, motion);
  const double rounding = 128.0 * kEpsilonOfMotion * greatest_length(tree_A, tree_B, motion);
  if (!(tolerance >= 8.0 * rounding && tolerance <= std::numeric_limits<double>::max()))
    throw std::invalid_argument("the tolerance of a first contact must be at least " + std::to_string(8.0 * rounding) +
                                " m here, where rounding errors are hidden");
  return FirstContactSearch(tree_A, tree_B, motion, tolerance, 0.5 * tolerance + rounding).run();
}

}  // namespace glissade::collision
