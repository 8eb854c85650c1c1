#include "features/contact_search.h"

#include <algorithm>
#include <array>
#include <bit>

#include <glissade/geometry/triangle_pair.h>

#include "features/contact_filter.h"
#include "features/corner_kernel.h"
#include "features/triangle_side.h"

namespace glissade::contact {
namespace {

/// In margins: the gap up to which a vertex over a face is checked for rims; the difference up to which two gaps count
/// as equal; the length past its end to which an edge is considered where it goes straight on.
constexpr double kNearRims = 2.0;
constexpr double kAsNear = 0.1;
constexpr double kPastEnd = 0.1;

/// Corners that wait to be looked at together.
class WaitingCorners {
 public:
  std::size_t count() const { return count_; }

  void add(const TriangleSide& of_corner, int i, const TriangleSide& of_triangle, bool is_of_obstacle) {
    put(of_corner.corner(i), corners_.x);
    for (int c = 0; c < 3; ++c) {
      const auto number = static_cast<std::size_t>(c);
      put(of_triangle.corner(c), corners_.triangle[number]);
      corners_.is_rim[number][count_] = of_triangle.is_flat(c) ? 0.0 : 1.0;
    }
    corners_.is_of_obstacle[count_++] = is_of_obstacle ? 1.0 : 0.0;
  }

  /// Looks at all that wait, after which none does.
  const CornersOverFaces& look() {
    if (count_ > 0) find_corners_over_faces(corners_, over_);
    count_ = 0;
    return over_;
  }

 private:
  void put(const Eigen::Vector3d& x, VectorsOfCorners& to) const {
    for (std::size_t axis = 0; axis < 3; ++axis)
      to[axis][count_] = x[static_cast<Eigen::Index>(axis)];
  }

  CornersOverTriangles corners_{};
  CornersOverFaces over_;
  std::size_t count_ = 0;
};

Eigen::Vector3d at_corner(const VectorsOfCorners& vectors, std::size_t corner) {
  return {vectors[0][corner], vectors[1][corner], vectors[2][corner]};
}

class ContactSearch {
 public:
  ContactSearch(std::span<const PlacedBody> bodies, std::size_t first_part, double reach, double margin,
                std::vector<Contact>& contacts, std::vector<GapsOfPair>* gaps)
      : bodies_(bodies),
        first_part_(static_cast<std::int32_t>(first_part)),
        reach_(reach),
        margin_(margin),
        contacts_(contacts),
        gaps_(gaps) {}

  /// Looks at these features of a pair, now or later, in the order of the calls. `is_near`: the pair is known to be
  /// near at the present poses, and not only at those of a search some steps ago.
  void search(const TrianglesOfBodies& pair, std::size_t number, FeaturePairs features, bool is_near) {
    const auto corners = static_cast<std::size_t>(std::popcount(features & kAllCorners));
    if (waiting_count_ == waiting_.size() || corners_.count() + corners > kCornersAtOnce) search_waiting();
    WaitingPair& waiting = waiting_[waiting_count_];
    waiting.bodies = pair.bodies;
    waiting.number = number;
    waiting.features = features;
    waiting.part.select(bodies_[static_cast<std::size_t>(pair.bodies.part)], pair.part_triangle);
    waiting.obstacle.select(bodies_[static_cast<std::size_t>(pair.bodies.obstacle)], pair.obstacle_triangle);
    if (!is_near && !waiting.part.may_be_near(waiting.obstacle, reach_)) {
      note_beyond(number);
      return;
    }
    for_each_feature_pair(features & kAllCorners, [&](int i, int with) {
      if (with == kPartCorner) {
        corners_.add(waiting.part, i, waiting.obstacle, false);
      } else {
        corners_.add(waiting.obstacle, i, waiting.part, true);
      }
    });
    ++waiting_count_;
  }

  /// Looks at all pairs that wait.
  void search_waiting() {
    const CornersOverFaces& over = corners_.look();
    std::size_t corner = 0;
    for (std::size_t k = 0; k < waiting_count_; ++k) {
      const WaitingPair& pair = waiting_[k];
      pair_ = &pair;
      part_ = &pair.part;
      obstacle_ = &pair.obstacle;
      for_each_feature_pair(pair.features, [&](int i, int with) {
        if (with == kPartCorner) {
          search_part_corner(i, over, corner++);
        } else if (with == kObstacleCorner) {
          search_obstacle_corner(i, over, corner++);
        } else {
          search_edges(i, with - kFirstEdges);
        }
      });
    }
    waiting_count_ = 0;
  }

  /// Leaves out a vertex over a face within a margin of the face's rim, if one of the vertex's edges crosses that rim:
  /// past the rim there is room, which both constraints together would deny. The contact of the edges is as near and
  /// sufficient.
  void leave_out_what_rims_hold() {
    std::erase_if(rims_, [&](const AtRim& rim) { return !rim_holds(contacts_[rim.contact], rim.edge); });
    if (rims_.empty()) return;
    auto rim = rims_.begin();
    std::size_t kept = rim->contact;
    for (std::size_t i = kept; i < contacts_.size(); ++i) {
      if (rim != rims_.end() && rim->contact == i) {
        ++rim;
      } else {
        contacts_[kept++] = contacts_[i];
      }
    }
    contacts_.resize(kept);
  }

 private:
  /// A pair that waits until there are enough corners to look at.
  struct WaitingPair {
    BodyPair bodies;
    std::size_t number;  // among the candidates
    FeaturePairs features;
    TriangleSide part{1.0};
    TriangleSide obstacle{-1.0};
  };

  /// A contact of a vertex over a face, near an edge of that face.
  struct AtRim {
    std::size_t contact;
    std::int32_t edge;
  };

  /// A near contact of two edges.
  struct Crossing {
    std::size_t contact;
    std::int32_t part_edge;
    std::int32_t obstacle_edge;
  };

  /// Notes that the contact added next is near the rim `edge`; −1 means no rim.
  void note_rim(std::int32_t edge) {
    if (edge >= 0) rims_.push_back({contacts_.size(), edge});
  }

  bool rim_holds(const Contact& contact, std::int32_t edge) const {
    const bool is_part_vertex = contact.kind == ContactKind::kVertexFace;
    const auto body = static_cast<std::size_t>(is_part_vertex ? contact.part + first_part_ : contact.obstacle);
    const geometry::MeshTopology& topology = bodies_[body].body->topology;
    const std::int32_t vertex = is_part_vertex ? contact.part_feature : contact.obstacle_feature;
    return std::any_of(crossings_.begin(), crossings_.end(), [&](const Crossing& of_edges) {
      if ((is_part_vertex ? of_edges.obstacle_edge : of_edges.part_edge) != edge) return false;
      const Contact& other = contacts_[of_edges.contact];
      if (other.part != contact.part || other.obstacle != contact.obstacle ||
          other.gap > contact.gap + kAsNear * margin_) {
        return false;
      }
      const std::int32_t crossing = is_part_vertex ? other.part_feature : other.obstacle_feature;
      const auto& ends = topology.edges()[static_cast<std::size_t>(crossing)].vertices;
      return ends[0] == vertex || ends[1] == vertex;
    });
  }

  /// Adds the contact of a corner of one side over the face of the other, if it is within reach.
  void add_over_face(ContactKind kind, std::int32_t part_feature, std::int32_t obstacle_feature,
                     const TriangleSide& of_face, const Eigen::Vector3d& p, const CornersOverFaces& over,
                     std::size_t corner) {
    const double gap = over.gap[corner];
    if (!is_within_reach(gap)) return;
    if (gap <= kNearRims * margin_) note_rim(of_face.rim_near(at_corner(over.point, corner), margin_));
    add(kind, part_feature, obstacle_feature, at_corner(over.n, corner), p, gap, over.to_rims[corner]);
  }

  void search_part_corner(int i, const CornersOverFaces& over, std::size_t corner) {
    const Eigen::Vector3d& x = part_->corner(i);
    if (over.is_inside[corner] > 0.0) {
      add_over_face(ContactKind::kVertexFace, part_->vertex(i), obstacle_->triangle(), *obstacle_, x, over, corner);
      return;
    }
    const geometry::ClosestOnTriangle on = obstacle_->closest_to(x, kPastEnd * margin_);
    Eigen::Vector3d n;
    const double gap = gap_and_normal(on.point, x, n);
    if (gap < 0.0) return;
    switch (on.region) {
      case geometry::Region::kFace:
        break;  // seen above
      case geometry::Region::kEdge:
        if (obstacle_->owns_edge(on.index) && obstacle_->edge_is_nearest(on.index, n, margin_) &&
            part_->corner_is_nearest(i, n, margin_)) {
          add(ContactKind::kVertexEdge, part_->vertex(i), obstacle_->edge(on.index), n, x, gap, gap);
        }
        break;
      case geometry::Region::kVertex:
        if (obstacle_->owns_corner(on.index) && obstacle_->corner_is_nearest(on.index, n, margin_) &&
            part_->corner_is_nearest(i, n, margin_)) {
          add(ContactKind::kVertexVertex, part_->vertex(i), obstacle_->vertex(on.index), n, x, gap, gap);
        }
        break;
    }
  }

  void search_obstacle_corner(int i, const CornersOverFaces& over, std::size_t corner) {
    const Eigen::Vector3d& y = obstacle_->corner(i);
    if (over.is_inside[corner] > 0.0) {
      add_over_face(ContactKind::kFaceVertex, part_->triangle(), obstacle_->vertex(i), *part_,
                    at_corner(over.point, corner), over, corner);
      return;
    }
    const geometry::ClosestOnTriangle on = part_->closest_to(y, kPastEnd * margin_);
    Eigen::Vector3d n;
    const double gap = gap_and_normal(y, on.point, n);
    if (gap < 0.0 || on.region != geometry::Region::kEdge) return;  // vertex–vertex is found from the part's side
    if (part_->owns_edge(on.index) && part_->edge_is_nearest(on.index, n, margin_) &&
        obstacle_->corner_is_nearest(i, n, margin_)) {
      add(ContactKind::kEdgeVertex, part_->edge(on.index), obstacle_->vertex(i), n, on.point, gap, gap);
    }
  }

  void search_edges(int i, int j) {
    geometry::SegmentPoints closest;
    if (!geometry::closest_points_of_lines(part_->corner(i), part_->corner((i + 1) % 3), obstacle_->corner(j),
                                           obstacle_->corner((j + 1) % 3), closest) ||
        !part_->is_on_edge(i, closest.along_p, kPastEnd * margin_) ||
        !obstacle_->is_on_edge(j, closest.along_q, kPastEnd * margin_)) {
      return;
    }
    Eigen::Vector3d n;
    const double gap = gap_and_normal(closest.q, closest.p, n);
    if (gap < 0.0 || !part_->edge_is_nearest(i, n, margin_) || !obstacle_->edge_is_nearest(j, n, margin_)) return;
    if (gap <= (kNearRims + kAsNear) * margin_)
      crossings_.push_back({contacts_.size(), part_->edge(i), obstacle_->edge(j)});
    add(ContactKind::kEdgeEdge, part_->edge(i), obstacle_->edge(j), n, closest.p, gap,
        std::min(part_->distance_to_ends(i, closest.along_p), obstacle_->distance_to_ends(j, closest.along_q)));
  }

  /// The gap between a point of the obstacle and one of the part, −1 where it is out of reach or has no direction.
  double gap_and_normal(const Eigen::Vector3d& q, const Eigen::Vector3d& p, Eigen::Vector3d& n) {
    n = p - q;
    const double gap = n.norm();
    if (!is_within_reach(gap)) return -1.0;
    n /= gap;
    return gap;
  }

  /// Whether a contact with this gap is within reach and has a direction.
  bool is_within_reach(double gap) {
    if (gap > reach_) note_beyond(pair_->number);
    return gap <= reach_ && gap != 0.0;
  }

  /// Notes that the pair may have contacts beyond reach.
  void note_beyond(std::size_t number) {
    if (gaps_ != nullptr) (*gaps_)[number].beyond = (*gaps_)[number].least;
  }

  // The normal of a contact with a vertex or an edge beside it turns with the motion; its gap is a measure of how fast.
  void add(ContactKind kind, std::int32_t part_feature, std::int32_t obstacle_feature, const Eigen::Vector3d& n,
           const Eigen::Vector3d& p, double gap, double range) {
    Contact& contact =
        contacts_.emplace_back(Contact{kind, part_->triangle(), pair_->bodies.obstacle, obstacle_->triangle(), n, p,
                                       gap, 0.0, part_feature, obstacle_feature, pair_->bodies.part - first_part_});
    contact.range = range;
  }

  std::span<const PlacedBody> bodies_;
  std::int32_t first_part_;
  std::array<WaitingPair, 2 * kCornersAtOnce> waiting_;
  std::size_t waiting_count_ = 0;
  WaitingCorners corners_;  // of the waiting pairs
  // The pair that is looked at, and its sides.
  const WaitingPair* pair_ = nullptr;
  const TriangleSide* part_ = nullptr;
  const TriangleSide* obstacle_ = nullptr;
  double reach_;
  double margin_;
  std::vector<Contact>& contacts_;
  std::vector<GapsOfPair>* gaps_;
  std::vector<AtRim> rims_;  // ascending
  std::vector<Crossing> crossings_;
};

}  // namespace

void find_contacts(std::span<const PlacedBody> bodies, std::size_t first_part,
                   std::span<const TrianglesOfBodies> candidates, double reach, double margin,
                   std::vector<Contact>& contacts, std::vector<GapsOfPair>* gaps,
                   std::span<const KnownFeatures> known) {
  contacts.clear();
  if (gaps != nullptr) gaps->clear();
  ContactSearch search(bodies, first_part, reach, margin, contacts, gaps);
  ContactFilter filter(bodies, reach, kPastEnd * margin, margin);
  for (std::size_t first = 0; first < candidates.size(); first += ContactFilter::kMostPairs) {
    const auto pairs = candidates.subspan(first, std::min(ContactFilter::kMostPairs, candidates.size() - first));
    filter.look(pairs, known.empty() ? known : known.subspan(first, pairs.size()));
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (gaps != nullptr)
        gaps->push_back({filter.gap(i), filter.gap_beyond(i), filter.gap_left_out(i), filter.features(i)});
      if (filter.nearest(i) != 0) search.search(pairs[i], first + i, filter.nearest(i), filter.was_looked_at(i));
    }
  }
  search.search_waiting();
  search.leave_out_what_rims_hold();
}

}  // namespace glissade::contact
