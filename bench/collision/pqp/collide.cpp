// Yes or no, and all pairs: descent of two trees of oriented boxes (Gottschalk and others 1996, sections 3 and 5).

#include "boxes.h"
#include "query.h"
#include "triangles.h"
#include "vectors.h"

namespace glissade::bench::pqp {
namespace {

// With `kAll` all pairs of triangles, otherwise the first.
template <bool kAll>
class Collision {
 public:
  Collision(const Tree& tree_A, const Tree& tree_B, const Pose& X_AB, std::span<TriangleIds> pairs)
      : boxes_A_(tree_A.boxes.data()),
        boxes_B_(tree_B.boxes.data()),
        triangles_A_(tree_A.triangles.data()),
        triangles_B_(tree_B.triangles.data()),
        ids_A_(tree_A.ids.data()),
        ids_B_(tree_B.ids.data()),
        X_AB_(X_AB),
        pairs_(pairs.data()),
        room_(pairs.size()) {}

  std::size_t count() {
    const Columns X_of_roots = of_child(seen_from_child(columns(X_AB_), boxes_A_[0].X_PN), boxes_B_[0].X_PN);
    if (!are_apart(X_of_roots, boxes_A_[0], boxes_B_[0])) visit(X_of_roots, boxes_A_[0], boxes_B_[0]);
    return count_;
  }

 private:
  // Two boxes that are not apart. X_AB is the pose of the second in the frame of the first. Whether to stop.
  bool visit(const Columns& X_AB, const BoxNode& a, const BoxNode& b) {
    if (a.child < 0 && b.child < 0) return compare_triangles(~a.child, ~b.child);
    if (b.child < 0 || (a.child >= 0 && squared_diagonal(a) > squared_diagonal(b))) {
      const BoxNode* const children = boxes_A_ + a.child;
      return visit_unless_apart(seen_from_child(X_AB, children[0].X_PN), children[0], b) ||
             visit_unless_apart(seen_from_child(X_AB, children[1].X_PN), children[1], b);
    }
    const BoxNode* const children = boxes_B_ + b.child;
    return visit_unless_apart(of_child(X_AB, children[0].X_PN), a, children[0]) ||
           visit_unless_apart(of_child(X_AB, children[1].X_PN), a, children[1]);
  }

  static float squared_diagonal(const BoxNode& box) {
    return box.half[0] * box.half[0] + box.half[1] * box.half[1] + box.half[2] * box.half[2];
  }

  bool visit_unless_apart(const Columns& X_AB, const BoxNode& a, const BoxNode& b) {
    return !are_apart(X_AB, a, b) && visit(X_AB, a, b);
  }

  bool compare_triangles(std::int32_t a, std::int32_t b) {
    if (!overlap(corners(triangles_A_[a]), corners_in_A(X_AB_, triangles_B_[b]))) return false;
    if (count_ < room_) pairs_[count_] = {ids_A_[a], ids_B_[b]};
    ++count_;
    return !kAll;
  }

  const BoxNode* boxes_A_;
  const BoxNode* boxes_B_;
  const TriangleNode* triangles_A_;
  const TriangleNode* triangles_B_;
  const std::int32_t* ids_A_;
  const std::int32_t* ids_B_;
  const Pose& X_AB_;
  TriangleIds* pairs_;
  std::size_t room_;
  std::size_t count_ = 0;
};

}  // namespace

bool intersects(const Tree& tree_A, const Tree& tree_B, const Pose& X_AB) {
  return Collision<false>(tree_A, tree_B, X_AB, {}).count() > 0;
}

std::size_t intersecting_pairs(const Tree& tree_A, const Tree& tree_B, const Pose& X_AB, std::span<TriangleIds> pairs) {
  return Collision<true>(tree_A, tree_B, X_AB, pairs).count();
}

}  // namespace glissade::bench::pqp
