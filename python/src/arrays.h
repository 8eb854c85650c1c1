#pragma once

/// NumPy arrays as the library's types, and back. Every function that reads an argument throws pybind11::type_error for
/// something that is no array of real numbers, and std::invalid_argument for a wrong shape or value. The message begins
/// with the name of the argument.

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <glissade/geometry/pose_trajectory.h>
#include <glissade/hands/hand.h>

namespace glissade::python {

namespace py = pybind11;

/// Numbers in rows, one after another, in double precision.
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// The argument as numbers, whatever its real type and its strides.
Numbers numbers_from(const py::object& argument, const std::string& name);

/// Throws std::invalid_argument for a number that is not finite.
void check_finite(const Numbers& numbers, const std::string& name);

/// One pose, or several in an array: rows (…, 7) of x, y, z (metres) and the quaternion qw, qx, qy, qz, or matrices
/// (…, 4, 4). A quaternion may be up to 1e-3 longer or shorter than 1. A matrix keeps its bits. The array is the
/// caller's own if it has such numbers, so other threads must not change it meanwhile: a copy would slow short queries.
class Poses {
 public:
  /// Throws for an array that has not the shape of poses.
  Poses(const py::object& argument, std::string name);

  /// Throws if `operator[]` throws for any pose. For work that takes much longer than the check.
  void check() const;

  std::size_t size() const { return static_cast<std::size_t>(numbers_.size() / values_each_); }
  /// Of the array without the axes of a pose; empty for one pose.
  const std::vector<py::ssize_t>& shape() const { return shape_; }
  bool is_single() const { return shape_.empty(); }

  /// Pose i in the order of the rows. Needs no interpreter lock. Throws std::invalid_argument, naming the pose, if it
  /// is no rotation and translation within 1e9 m.
  Eigen::Isometry3d operator[](std::size_t i) const;
  std::vector<Eigen::Isometry3d> all() const;

 private:
  Numbers numbers_;
  std::string name_;
  std::vector<py::ssize_t> shape_;
  py::ssize_t values_each_ = 0;
};

/// Exactly one pose.
Eigen::Isometry3d pose_from(const py::object& argument, const std::string& name);

/// Matrices of the shape (…, 4, 4).
py::array_t<double> to_array(std::span<const Eigen::Isometry3d> poses, std::vector<py::ssize_t> shape);
py::array_t<double> to_array(const Eigen::Isometry3d& pose);

/// A point or vector of three numbers.
Eigen::Vector3d vector_from(const py::object& argument, const std::string& name);
py::array_t<double> to_array(const Eigen::Vector3d& vector);

/// A time of at most 1e9 s.
std::chrono::nanoseconds nanoseconds_from(double time_s, const std::string& name);

/// One row of a motion for each time (n,) in seconds and pose.
geometry::PoseTrajectory trajectory_from(const py::object& times_s, const std::string& name_of_times,
                                         const py::object& poses, const std::string& name_of_poses);

/// One number for each joint of a hand, in the order of hands::kJointNames.
hands::JointValues joints_from(const py::object& argument, const std::string& name);

/// An array of this shape without values.
template <typename Number>
py::array_t<Number> new_array(const std::vector<py::ssize_t>& shape,
                              std::initializer_list<py::ssize_t> last_axes = {}) {
  std::vector<py::ssize_t> all = shape;
  all.insert(all.end(), last_axes);
  return py::array_t<Number>(all);
}

}  // namespace glissade::python
