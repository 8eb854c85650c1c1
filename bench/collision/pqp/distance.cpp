// Distance: descent of two trees of rectangles swept by spheres, the nearer children first, with the least distance so
// far as the bound (Larsen and others 1999).

#include <cmath>

#include "query.h"
#include "rectangles.h"
#include "triangles.h"
#include "vectors.h"

namespace glissade::bench::pqp {
namespace {

class Search {
 public:
  Search(const Tree& tree_A, const Tree& tree_B, const Pose& X_AB, const TriangleIds& nearest)
      : volumes_A_(tree_A.rectangles.data()),
        volumes_B_(tree_B.rectangles.data()),
        triangles_A_(tree_A.triangles.data()),
        triangles_B_(tree_B.triangles.data()),
        X_AB_(X_AB),
        nearest_(nearest) {}

  float distance() {
    compare_triangles(nearest_.A, nearest_.B);
    const Columns X_of_roots = of_child(seen_from_child(columns(X_AB_), volumes_A_[0].X_PN), volumes_B_[0].X_PN);
    visit(X_of_roots, volumes_A_[0], volumes_B_[0]);
    return distance_;
  }

  const TriangleIds& nearest() const { return nearest_; }

 private:
  // X_AB is the pose of the second volume in the frame of the first.
  void visit(const Columns& X_AB, const RectangleNode& a, const RectangleNode& b) {
    if (a.child < 0 && b.child < 0) {
      compare_triangles(~a.child, ~b.child);
    } else if (b.child < 0 || (a.child >= 0 && size(a) > size(b))) {
      const RectangleNode* const children = volumes_A_ + a.child;
      visit_nearer_first(seen_from_child(X_AB, children[0].X_PN), children[0], b,
                         seen_from_child(X_AB, children[1].X_PN), children[1], b);
    } else {
      const RectangleNode* const children = volumes_B_ + b.child;
      visit_nearer_first(of_child(X_AB, children[0].X_PN), a, children[0], of_child(X_AB, children[1].X_PN), a,
                         children[1]);
    }
  }

  void visit_nearer_first(const Columns& X_AB_1, const RectangleNode& a_1, const RectangleNode& b_1,
                          const Columns& X_AB_2, const RectangleNode& a_2, const RectangleNode& b_2) {
    const float bound_1 = distance_of(X_AB_1, a_1, b_1);
    const float bound_2 = distance_of(X_AB_2, a_2, b_2);
    if (bound_2 < bound_1) {
      if (bound_2 < distance_) visit(X_AB_2, a_2, b_2);
      if (bound_1 < distance_) visit(X_AB_1, a_1, b_1);
    } else {
      if (bound_1 < distance_) visit(X_AB_1, a_1, b_1);
      if (bound_2 < distance_) visit(X_AB_2, a_2, b_2);
    }
  }

  static float size(const RectangleNode& volume) {
    return std::sqrt(volume.sides[0] * volume.sides[0] + volume.sides[1] * volume.sides[1]) + 2.0F * volume.radius;
  }

  void compare_triangles(std::int32_t a, std::int32_t b) {
    const float squared =
        squared_distance_below(squared_distance_, corners(triangles_A_[a]), corners_in_A(X_AB_, triangles_B_[b]));
    if (squared >= squared_distance_) return;
    squared_distance_ = squared;
    distance_ = std::sqrt(squared);
    nearest_ = {a, b};
  }

  const RectangleNode* volumes_A_;
  const RectangleNode* volumes_B_;
  const TriangleNode* triangles_A_;
  const TriangleNode* triangles_B_;
  const Pose& X_AB_;
  TriangleIds nearest_;
  float squared_distance_ = HUGE_VALF;
  float distance_ = HUGE_VALF;
};

}  // namespace

float distance(const Tree& tree_A, const Tree& tree_B, const Pose& X_AB, TriangleIds& nearest) {
  Search search(tree_A, tree_B, X_AB, nearest);
  const float least = search.distance();
  nearest = search.nearest();
  return least;
}

}  // namespace glissade::bench::pqp
