#include "arrays.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>
#include <utility>

#include <glissade/files/pose_rules.h>
#include <glissade/files/text.h>
#include <glissade/geometry/displacement.h>

namespace glissade::python {

namespace {

/// Numbers of a pose.
constexpr py::ssize_t kRow = 7, kMatrix = 16;

/// The defect from which on a simulation refuses a pose. Queries would take ten times as much.
constexpr double kLargestDefect = 1e-4;

std::string shape_of(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t axis = 0; axis < array.ndim(); ++axis)
    text += (axis > 0 ? ", " : "") + std::to_string(array.shape(axis));
  return text + (array.ndim() == 1 ? ",)" : ")");
}

/// The name of the pose with this number, in the order of the rows.
std::string name_of_pose(const std::string& name, std::size_t pose, const std::vector<py::ssize_t>& shape) {
  std::string indices;
  std::size_t rest = pose;
  for (std::size_t axis = shape.size(); axis-- > 0;) {
    const auto length = static_cast<std::size_t>(shape[axis]);
    indices = std::to_string(rest % length) + (indices.empty() ? "" : ", ") + indices;
    rest /= length;
  }
  return indices.empty() ? name : name + "[" + indices + "]";
}

/// The name of a pose of an argument, made only for messages.
struct NameOfPose {
  const std::string& name;
  const std::vector<py::ssize_t>& shape;
  std::size_t pose;

  std::string operator()() const { return name_of_pose(name, pose, shape); }
};

Eigen::Isometry3d pose_from_row(const double* row, const NameOfPose& name) {
  const Eigen::Quaterniond q(row[3], row[4], row[5], row[6]);
  const Eigen::Vector3d p(row[0], row[1], row[2]);
  if (!p.allFinite() || !q.coeffs().allFinite())
    throw std::invalid_argument(name() + " has a number that is not finite");
  try {
    return files::checked_pose(p, q, "");
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(name() + error.what());
  }
}

/// False for a number that is not finite, too.
bool is_near(const Eigen::Vector3d& p) {
  return std::abs(p.x()) <= files::kLargestCoordinate_m && std::abs(p.y()) <= files::kLargestCoordinate_m &&
         std::abs(p.z()) <= files::kLargestCoordinate_m;
}

/// Throws for a matrix that is no pose.
void check_pose(const Eigen::Isometry3d& X, const Eigen::RowVector4d& last_row, const NameOfPose& name) {
  if (!X.affine().allFinite() || !last_row.allFinite())
    throw std::invalid_argument(name() + " has a number that is not finite");
  if (last_row != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0))
    throw std::invalid_argument(name() + ": the last row of a pose is 0, 0, 0, 1");
  for (const double coordinate : X.translation()) {
    if (std::abs(coordinate) > files::kLargestCoordinate_m)
      throw std::invalid_argument(name() + ": the position " + files::format_number(coordinate) + " is beyond 1e9 m");
  }
  if (geometry::rotation_defect(X.linear()) >= kLargestDefect)
    throw std::invalid_argument(name() + " has no rotation; its columns must be of length 1, at right angles");
  if (!geometry::is_right_handed(X.linear())) throw std::invalid_argument(name() + " is a reflection");
}

/// Whether a matrix is certainly a pose: true for all but a few. A short query takes about thirty times as long.
bool is_surely_pose(const double* values) {
  using Row = Eigen::Map<const Eigen::Vector3d>;  // of the rotation, whose transpose is a rotation, too
  const Row x(values), y(values + 4), z(values + 8);
  const double defect = std::abs(x.squaredNorm() - 1.0) + std::abs(y.squaredNorm() - 1.0) + std::abs(x.dot(y)) +
                        (x.cross(y) - z).lpNorm<1>();
  return defect < 0.01 * kLargestDefect && is_near({values[3], values[7], values[11]}) && values[12] == 0.0 &&
         values[13] == 0.0 && values[14] == 0.0 && values[15] == 1.0;
}

Eigen::Isometry3d pose_from_matrix(const double* values, const NameOfPose& name) {
  Eigen::Isometry3d X;
  X.matrix().topRows<3>() = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(values);
  X.makeAffine();
  if (!is_surely_pose(values)) check_pose(X, Eigen::Map<const Eigen::RowVector4d>(values + 12), name);
  return X;
}

}  // namespace

Numbers numbers_from(const py::object& argument, const std::string& name) {
  const py::array array = py::array::ensure(argument);
  if (!array) {
    PyErr_Clear();
    throw py::type_error(name + " is no array of numbers");
  }
  if (const char kind = array.dtype().kind(); kind != 'f' && kind != 'i' && kind != 'u') {
    throw py::type_error(name + " is an array of " + std::string(py::str(array.dtype())) + ", not of real numbers");
  }
  Numbers numbers = Numbers::ensure(array);
  if (!numbers) throw std::bad_alloc();
  return numbers;
}

void check_finite(const Numbers& numbers, const std::string& name) {
  const double* const end = numbers.data() + numbers.size();
  if (!std::all_of(numbers.data(), end, [](double number) { return std::isfinite(number); }))
    throw std::invalid_argument(name + " has a number that is not finite");
}

Poses::Poses(const py::object& argument, std::string name)
    : numbers_(numbers_from(argument, name)), name_(std::move(name)) {
  const py::ssize_t axes = numbers_.ndim();
  const bool are_rows = axes >= 1 && numbers_.shape(axes - 1) == kRow;
  const bool are_matrices = axes >= 2 && numbers_.shape(axes - 1) == 4 && numbers_.shape(axes - 2) == 4;
  if (!are_rows && !are_matrices) {
    throw std::invalid_argument(name_ + " has the shape " + shape_of(numbers_) +
                                ", but poses have the shape (7,), (n, 7), (4, 4) or (n, 4, 4)");
  }
  shape_.assign(numbers_.shape(), numbers_.shape() + axes - (are_rows ? 1 : 2));
  values_each_ = are_rows ? kRow : kMatrix;
}

void Poses::check() const {
  for (std::size_t i = 0; i < size(); ++i)
    (*this)[i];
}

Eigen::Isometry3d Poses::operator[](std::size_t i) const {
  const double* const values = numbers_.data() + static_cast<py::ssize_t>(i) * values_each_;
  const NameOfPose own_name{name_, shape_, i};
  return values_each_ == kRow ? pose_from_row(values, own_name) : pose_from_matrix(values, own_name);
}

std::vector<Eigen::Isometry3d> Poses::all() const {
  std::vector<Eigen::Isometry3d> poses;
  poses.reserve(size());
  for (std::size_t i = 0; i < size(); ++i)
    poses.push_back((*this)[i]);
  return poses;
}

Eigen::Isometry3d pose_from(const py::object& argument, const std::string& name) {
  const Poses poses(argument, name);
  if (!poses.is_single()) throw std::invalid_argument(name + " must be one pose, of the shape (7,) or (4, 4)");
  return poses[0];
}

py::array_t<double> to_array(std::span<const Eigen::Isometry3d> poses, std::vector<py::ssize_t> shape) {
  py::array_t<double> array = new_array<double>(shape, {4, 4});
  double* values = array.mutable_data();
  for (const Eigen::Isometry3d& X : poses) {
    Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> matrix(values);
    matrix = X.matrix();
    values += 16;
  }
  return array;
}

py::array_t<double> to_array(const Eigen::Isometry3d& pose) {
  return to_array(std::span(&pose, 1), {});
}

Eigen::Vector3d vector_from(const py::object& argument, const std::string& name) {
  const Numbers array = numbers_from(argument, name);
  if (array.ndim() != 1 || array.shape(0) != 3)
    throw std::invalid_argument(name + " has the shape " + shape_of(array) + " instead of (3,)");
  return {array.at(0), array.at(1), array.at(2)};
}

py::array_t<double> to_array(const Eigen::Vector3d& vector) {
  return py::array_t<double>(3, vector.data());
}

std::chrono::nanoseconds nanoseconds_from(double time_s, const std::string& name) {
  if (!(std::abs(time_s) <= 1e9)) throw std::invalid_argument(name + " is beyond 1e9 s");
  return std::chrono::round<std::chrono::nanoseconds>(std::chrono::duration<double>(time_s));
}

geometry::PoseTrajectory trajectory_from(const py::object& times_s, const std::string& name_of_times,
                                         const py::object& poses, const std::string& name_of_poses) {
  const Numbers times = numbers_from(times_s, name_of_times);
  const Poses X(poses, name_of_poses);
  if (times.ndim() != 1 || X.shape().size() != 1 || times.shape(0) != X.shape()[0])
    throw std::invalid_argument(name_of_times + " and " + name_of_poses + " must be n times (seconds) and n poses");
  std::vector<geometry::TimedPose> rows;
  for (std::size_t i = 0; i < X.size(); ++i) {
    const std::string name = name_of_times + "[" + std::to_string(i) + "]";
    rows.push_back({nanoseconds_from(times.at(static_cast<py::ssize_t>(i)), name), X[i]});
  }
  return geometry::PoseTrajectory(std::move(rows));
}

hands::JointValues joints_from(const py::object& argument, const std::string& name) {
  const Numbers values = numbers_from(argument, name);
  if (values.ndim() != 1 || values.shape(0) != hands::kJoints)
    throw std::invalid_argument(name + " must have the shape (22,), in the order of JOINT_NAMES");
  check_finite(values, name);
  hands::JointValues joints;
  std::copy_n(values.data(), joints.size(), joints.begin());
  return joints;
}

}  // namespace glissade::python
