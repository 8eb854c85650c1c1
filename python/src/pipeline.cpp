#include <cstdint>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <pybind11/stl.h>

#include <glissade/collision/collision_pipeline.h>
#include <glissade/collision/convex_hull.h>

#include "arrays.h"
#include "guarded.h"
#include "module.h"
#include "trees.h"

namespace glissade::python {

namespace {

using collision::ConvexHull;
using collision::DopTree;
using collision::ObjectId;

/// A world and its pipeline.
class Objects {
 public:
  Objects(int capacity, double greatest_distance, int threads)
      : world_(capacity), pipeline_(world_, clock_, {.greatest_distance = greatest_distance, .threads = threads}) {}

  std::uint64_t add(const std::shared_ptr<DopTree>& tree, const Eigen::Isometry3d& X_WO) {
    return number_of(world_.add({tree, hull_of(tree), X_WO}));
  }
  void remove(std::uint64_t object) { world_.remove(id_of(object)); }
  void disable_pair(std::uint64_t a, std::uint64_t b) { world_.disable_pair(id_of(a), id_of(b)); }

  void move(const std::vector<std::uint64_t>& objects, const std::vector<Eigen::Isometry3d>& X_WO) {
    for (std::size_t i = 0; i < objects.size(); ++i) {
      if (!world_.move(id_of(objects[i]), X_WO[i]))
        throw std::invalid_argument("object " + std::to_string(objects[i]) +
                                    " is not in this pipeline; those before it have moved");
    }
  }

  std::vector<std::uint64_t> step(double distance) {
    std::vector<std::uint64_t> pairs;
    for (const collision::ObjectPair& pair : pipeline_.step(distance).meeting) {
      pairs.push_back(number_of(pair.object_A));
      pairs.push_back(number_of(pair.object_B));
    }
    return pairs;
  }

 private:
  static std::uint64_t number_of(ObjectId id) { return std::uint64_t{id.generation} << 32U | id.index; }
  static ObjectId id_of(std::uint64_t number) {
    return {static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(number >> 32U)};
  }

  /// The hull of a tree, which all objects with this tree share.
  std::shared_ptr<const ConvexHull> hull_of(const std::shared_ptr<DopTree>& tree) {
    if (hulls_.size() >= swept_at_) {
      std::erase_if(hulls_, [](const auto& entry) { return entry.second.expired(); });
      swept_at_ = 2 * hulls_.size() + 16;
    }
    std::weak_ptr<const ConvexHull>& known = hulls_[tree];
    std::shared_ptr<const ConvexHull> hull = known.lock();
    if (hull == nullptr) known = hull = std::make_shared<const ConvexHull>(tree->mesh());
    return hull;
  }

  std::map<std::weak_ptr<DopTree>, std::weak_ptr<const ConvexHull>, std::owner_less<>> hulls_;
  std::size_t swept_at_ = 16;  // size of hulls_ at which those that no object has any more are taken out
  realtime::SteadyClock clock_;
  collision::World world_;
  collision::CollisionPipeline pipeline_;
};

using Pipeline = Guarded<Objects>;

std::uint64_t add(Pipeline& pipeline, const py::object& of, const py::object& X_WO) {
  const std::shared_ptr<DopTree> tree = tree_from(of, "tree");
  const Eigen::Isometry3d pose = X_WO.is_none() ? Eigen::Isometry3d::Identity() : pose_from(X_WO, "X_WO");
  return pipeline.with([&](Objects& objects) { return objects.add(tree, pose); });
}

void move(Pipeline& pipeline, const std::vector<std::uint64_t>& ids, const py::object& X_WO) {
  const Poses poses(X_WO, "X_WO");
  if (poses.size() != ids.size())
    throw std::invalid_argument(std::to_string(poses.size()) + " poses for " + std::to_string(ids.size()) + " objects");
  const std::vector<Eigen::Isometry3d> X = poses.all();  // before anything moves
  pipeline.with([&](Objects& objects) { objects.move(ids, X); });
}

py::array_t<std::uint64_t> step(Pipeline& pipeline, double distance) {
  const std::vector<std::uint64_t> pairs = pipeline.with([&](Objects& objects) { return objects.step(distance); });
  return py::array_t<std::uint64_t>({static_cast<py::ssize_t>(pairs.size() / 2), py::ssize_t{2}}, pairs.data());
}

}  // namespace

void add_pipeline(py::module_& module) {
  py::class_<Pipeline>(module, "Pipeline", R"(Many moving objects: finds the pairs that meet.

The cost of a step grows with the near pairs of which an object has moved, not with the number of objects. Founding paper,
section 2.)")
      .def(
          py::init<int, double, int>(), py::kw_only(), py::arg("capacity") = 4096, py::arg("greatest_distance") = 0.0,
          py::arg("threads") = 0,
          "capacity: most objects. greatest_distance: the largest distance of `step`, metres. threads: 0: one for each "
          "processor.")
      .def("add", &add, py::arg("tree"), py::arg("X_WO") = py::none(),
           "Adds an object at a pose and returns its number.")
      .def(
          "remove", [](Pipeline& of, std::uint64_t object) { of.with([&](Objects& all) { all.remove(object); }); },
          py::arg("object"), "Takes the object with this number out.")
      .def(
          "disable_pair",
          [](Pipeline& of, std::uint64_t a, std::uint64_t b) {
            of.with([&](Objects& all) { all.disable_pair(a, b); });
          },
          py::arg("a"), py::arg("b"), "Never compares these two objects.")
      .def("move", &move, py::arg("objects"), py::arg("X_WO"),
           "Sets the poses (n, 7) or (n, 4, 4) of the n objects with these numbers.")
      .def("step", &step, py::arg("distance") = 0.0,
           "The pairs (m, 2) of objects at most `distance` metres apart, ascending; with 0, those that touch.");
}

}  // namespace glissade::python
