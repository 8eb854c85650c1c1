#include "io/gltf_placement.h"

#include <cmath>
#include <vector>

#include "io/gltf_numbers.h"
#include "io/mesh_file.h"

namespace glissade::geometry {

using nlohmann::json;

Eigen::Affine3d affine(const std::filesystem::path& path, std::span<const double> numbers, const std::string& where) {
  for (const double number : numbers) {
    if (!is_coordinate(number)) reject_coordinate(path, where, number);
  }
  constexpr double kRounding = 1e-4;  // products and inverses in single precision
  Eigen::Matrix4d matrix = Eigen::Map<const Eigen::Matrix4d>(numbers.data());
  const Eigen::RowVector4d row = matrix.row(3);
  const Eigen::RowVector4d exact(0, 0, 0, 1);
  if ((row - exact).cwiseAbs().maxCoeff() > kRounding) {
    reject(path, where + ": its last row is " + json(std::vector<double>(row.begin(), row.end())).dump() +
                     ", not 0, 0, 0, 1");
  }
  matrix.row(3) = exact;
  return Eigen::Affine3d(matrix);
}

Eigen::Quaterniond unit_quaternion(const std::filesystem::path& path, std::span<const double> xyzw, double tolerance,
                                   const std::string& where) {
  const Eigen::Quaterniond q(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
  if (!(std::abs(q.norm() - 1.0) <= tolerance)) {
    reject(path, where + ": the quaternion " + json(std::vector<double>(xyzw.begin(), xyzw.end())).dump() +
                     " has the length " + json(q.norm()).dump() + ", not 1");
  }
  return q.normalized();
}

Eigen::Affine3d placement(const std::filesystem::path& path, const json& node, const std::string& where) {
  const auto given = [&](const char* key, std::vector<double> otherwise) {
    if (!node.contains(key)) return otherwise;
    std::vector<double> numbers = number_array(path, node.at(key), where + "." + key);
    if (numbers.size() != otherwise.size()) {
      reject(path, where + "." + key + " must have " + std::to_string(otherwise.size()) + " numbers");
    }
    return numbers;
  };
  for (const char* key : {"translation", "rotation", "scale"}) {
    if (node.contains("matrix") && node.contains(key)) reject(path, where + ": it has both a matrix and a " + key);
  }
  if (node.contains("matrix")) return affine(path, given("matrix", std::vector<double>(16)), where + ".matrix");
  constexpr double kRounding = 1e-3;
  const std::vector<double> translation = given("translation", {0, 0, 0});
  const Eigen::Quaterniond turn =
      unit_quaternion(path, given("rotation", {0, 0, 0, 1}), kRounding, where + ".rotation");
  const std::vector<double> scale = given("scale", {1, 1, 1});
  return Eigen::Translation3d(translation[0], translation[1], translation[2]) * turn *
         Eigen::Scaling(scale[0], scale[1], scale[2]);
}

}  // namespace glissade::geometry
