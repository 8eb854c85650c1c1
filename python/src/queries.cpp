#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pybind11/stl.h>

#include <glissade/collision/dop_query.h>

#include "arrays.h"
#include "for_each.h"
#include "module.h"
#include "trees.h"

namespace glissade::python {

namespace {

using collision::ClosePair;
using collision::CoherentWorkspace;
using collision::DopTree;
using collision::QueryWorkspace;
using collision::TrianglePair;

/// The two trees of a query.
struct Trees {
  Trees(const py::object& tree_A, const py::object& tree_B)
      : A(tree_from(tree_A, "tree_A")), B(tree_from(tree_B, "tree_B")) {}

  std::shared_ptr<DopTree> A;
  std::shared_ptr<DopTree> B;
};

/// Calls query(workspace, i) for each pose, with a workspace for each thread.
template <typename Workspace, typename Query>
void for_each_pose(const Poses& X_AB, int threads, const Query& query) {
  for_each(static_cast<std::int64_t>(X_AB.size()), threads, [&] {
    return [&query, workspace = std::make_shared<Workspace>()](std::int64_t i) {
      query(*workspace, static_cast<std::size_t>(i));
    };
  });
}

/// The same, with the workspace that the caller wants.
template <typename Query>
void for_each_pose(const Poses& X_AB, bool is_coherent, int threads, const Query& query) {
  if (is_coherent) {
    for_each_pose<CoherentWorkspace>(X_AB, threads, query);
  } else {
    for_each_pose<QueryWorkspace>(X_AB, threads, query);
  }
}

py::object intersects(const py::object& tree_A, const py::object& tree_B, const py::object& poses, double tolerance,
                      bool is_coherent, int threads) {
  const Trees trees(tree_A, tree_B);
  const Poses X_AB(poses, "X_AB");
  py::array_t<bool> answers = new_array<bool>(X_AB.shape());
  bool* const answer = answers.mutable_data();
  for_each_pose(X_AB, is_coherent, threads, [&](auto& workspace, std::size_t i) {
    answer[i] = collision::intersects(*trees.A, *trees.B, X_AB[i], workspace, tolerance);
  });
  if (X_AB.is_single()) return py::bool_(*answer);
  return answers;
}

py::object array_of(const std::vector<TrianglePair>& pairs) {
  static_assert(sizeof(TrianglePair) == 2 * sizeof(std::int32_t));
  py::array_t<std::int32_t> array = new_array<std::int32_t>({static_cast<py::ssize_t>(pairs.size())}, {2});
  std::int32_t* value = array.mutable_data();
  for (const TrianglePair& pair : pairs) {
    *value++ = pair.triangle_A;
    *value++ = pair.triangle_B;
  }
  return array;
}

/// One answer for one pose, else a list of them.
template <typename Answer, typename Convert>
py::object one_or_list(const Poses& X_AB, const std::vector<Answer>& answers, const Convert& convert) {
  if (X_AB.is_single()) return convert(answers.front());
  py::list list;
  for (const Answer& answer : answers)
    list.append(convert(answer));
  return list;
}

void check_is_list(const Poses& X_AB) {
  if (X_AB.shape().size() > 1) throw std::invalid_argument("X_AB must be one pose or a list of poses");
}

py::object pairs(const py::object& tree_A, const py::object& tree_B, const py::object& poses, double tolerance,
                 bool is_coherent, int threads) {
  const Trees trees(tree_A, tree_B);
  const Poses X_AB(poses, "X_AB");
  X_AB.check();
  check_is_list(X_AB);
  std::vector<std::vector<TrianglePair>> answers(X_AB.size());
  for_each_pose(X_AB, is_coherent, threads, [&](auto& workspace, std::size_t i) {
    collision::intersecting_pairs(*trees.A, *trees.B, X_AB[i], workspace, answers[i], tolerance);
  });
  return one_or_list(X_AB, answers, array_of);
}

/// Closest points, in the shape of the poses or of a list of pairs.
struct ClosestPoints {
  py::array_t<double> distance;
  py::array_t<double> p_A;
  py::array_t<double> p_B;
  py::array_t<std::int32_t> triangles;

  explicit ClosestPoints(const std::vector<py::ssize_t>& shape)
      : distance(new_array<double>(shape)),
        p_A(new_array<double>(shape, {3})),
        p_B(new_array<double>(shape, {3})),
        triangles(new_array<std::int32_t>(shape, {2})) {}
};

/// Where the closest points of one pose or pair go.
class Row {
 public:
  explicit Row(ClosestPoints& all)
      : distance_(all.distance.mutable_data()),
        p_A_(all.p_A.mutable_data()),
        p_B_(all.p_B.mutable_data()),
        triangles_(all.triangles.mutable_data()) {}

  void set(std::size_t i, double distance, const std::optional<ClosePair>& pair) const {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    const Eigen::Vector3d none = Eigen::Vector3d::Constant(kNaN);
    distance_[i] = distance;
    Eigen::Map<Eigen::Vector3d>(p_A_ + 3 * i) = pair ? pair->p_A : none;
    Eigen::Map<Eigen::Vector3d>(p_B_ + 3 * i) = pair ? pair->p_B : none;
    triangles_[2 * i] = pair ? pair->triangles.triangle_A : -1;
    triangles_[2 * i + 1] = pair ? pair->triangles.triangle_B : -1;
  }

 private:
  double* distance_;
  double* p_A_;
  double* p_B_;
  std::int32_t* triangles_;
};

py::object points_of(const std::vector<ClosePair>& pairs) {
  ClosestPoints points({static_cast<py::ssize_t>(pairs.size())});
  const Row row(points);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    row.set(i, pairs[i].distance, pairs[i]);
  return py::cast(std::move(points));
}

py::object pairs_within(const py::object& tree_A, const py::object& tree_B, const py::object& poses, double distance,
                        bool is_coherent, int threads) {
  const Trees trees(tree_A, tree_B);
  const Poses X_AB(poses, "X_AB");
  X_AB.check();
  check_is_list(X_AB);
  std::vector<std::vector<ClosePair>> answers(X_AB.size());
  for_each_pose(X_AB, is_coherent, threads, [&](auto& workspace, std::size_t i) {
    collision::pairs_within(*trees.A, *trees.B, X_AB[i], distance, workspace, answers[i]);
  });
  return one_or_list(X_AB, answers, points_of);
}

ClosestPoints distance(const py::object& tree_A, const py::object& tree_B, const py::object& poses, double limit,
                       bool is_coherent, int threads) {
  const Trees trees(tree_A, tree_B);
  const Poses X_AB(poses, "X_AB");
  X_AB.check();
  ClosestPoints points(X_AB.shape());
  const Row row(points);
  for_each_pose(X_AB, is_coherent, threads, [&](auto& workspace, std::size_t i) {
    const collision::MeshDistance answer = collision::distance(*trees.A, *trees.B, X_AB[i], workspace, limit);
    row.set(i, answer.distance, answer.nearest);
  });
  return points;
}

py::array_t<double> way_out(const py::object& tree_A, const py::object& tree_B, const py::object& poses,
                            double clearance, int threads) {
  const Trees trees(tree_A, tree_B);
  const Poses X_AB(poses, "X_AB");
  X_AB.check();
  py::array_t<double> ways = new_array<double>(X_AB.shape(), {3});
  double* const way = ways.mutable_data();
  for_each_pose<QueryWorkspace>(X_AB, threads, [&](QueryWorkspace& workspace, std::size_t i) {
    Eigen::Map<Eigen::Vector3d>(way + 3 * i) =
        collision::find_way_out(*trees.A, *trees.B, X_AB[i], workspace, clearance).way_out_A;
  });
  return ways;
}

void add_closest_points(py::module_& module) {
  py::class_<ClosestPoints>(module, "ClosestPoints",
                            "The closest points of two meshes for each pose, or of each pair of triangles.")
      .def_readonly("distance", &ClosestPoints::distance,
                    "(…) metres: 0 where the meshes intersect, the limit where nothing is nearer")
      .def_readonly(
          "p_A", &ClosestPoints::p_A,
          "(…, 3) on A, in the frame of A, metres; NaN where the meshes intersect or nothing is nearer than the limit")
      .def_readonly("p_B", &ClosestPoints::p_B, "(…, 3) on B, in the frame of A, metres; NaN like p_A")
      .def_readonly("triangles", &ClosestPoints::triangles,
                    "(…, 2) numbers of the triangles of A and B; -1 where there are no closest points")
      .def("__len__", [](const ClosestPoints& points) { return py::len(points.distance); })
      .def("__repr__", [](const ClosestPoints& points) {
        return "<glissade.ClosestPoints " + py::repr(points.distance).cast<std::string>() + ">";
      });
}

}  // namespace

void add_queries(py::module_& module) {
  add_closest_points(module);
  const auto A = py::arg("tree_A");
  const auto B = py::arg("tree_B");
  const auto poses = py::arg("X_AB");
  const auto only_names = py::kw_only();
  const auto coherent = py::arg("coherent") = false;
  const auto threads = py::arg("threads") = 1;
  module.def("intersects", &intersects, A, B, poses, py::arg("tolerance") = 0.0, only_names, coherent, threads,
             R"(Whether two meshes are at most `tolerance` metres apart; with 0, whether they intersect.

tree_A, tree_B: a Tree of each mesh. X_AB: the pose of B in the frame of A, (7,) or (4, 4), or n of them, (n, 7) or
(n, 4, 4). The answer is a bool, or an array of n. It is exact: that of real arithmetic on the vertices of A and the
transformed vertices of B. Touching counts. A mesh has no inside: B wholly inside a closed A does not intersect it.
coherent: the poses are a path, so neighbours share their work; the answers are the same. threads: that work on the poses.
Other Python threads run meanwhile, but must not change the arrays. Raises ValueError, naming the pose, for a pose that is
no rotation and translation within 1e9 m.)");
  module.def("pairs", &pairs, A, B, poses, py::arg("tolerance") = 0.0, only_names, coherent, threads,
             R"(All pairs of triangles at most `tolerance` metres apart; with 0, those that intersect.

Returns an array (m, 2) of triangles of A and B, in ascending order, or a list of such arrays for several poses. For the
other arguments, see `intersects`.)");
  module.def("pairs_within", &pairs_within, A, B, poses, py::arg("distance"), only_names, coherent, threads,
             R"(All pairs of triangles at most `distance` metres apart, with their closest points.

Returns a ClosestPoints in ascending order of the triangles, or a list of them for several poses. For the other arguments,
see `intersects`.)");
  module.def("distance", &distance, A, B, poses, py::arg("limit") = std::numeric_limits<double>::infinity(), only_names,
             coherent, threads,
             R"(The least distance of two meshes, if it is less than `limit` metres, with the closest points.

Returns a ClosestPoints with an entry for each pose: 0 and NaN points where the meshes intersect. The distance is that of
the surfaces, also for B wholly inside a closed A. A small limit saves time. For the other arguments, see `intersects`.)");
  module.def(
      "way_out", &way_out, A, B, poses, py::arg("clearance") = 0.0, only_names, threads,
      R"(A short translation of B, in the frame of A, after which the meshes are farther than `clearance` metres apart.

Returns (3,) or (n, 3) metres: zero where they already are, as where B is wholly inside a closed A. Its length is an upper
bound of the depth of penetration, which a query at the translated pose has confirmed. clearance: 0 to 1e9. For the other arguments, see
`intersects`.)");
}

}  // namespace glissade::python
