#include <cstdint>

#include <glissade/apps/record/mcap_values.h>
#include <glissade/viewer/page.h>

namespace glissade::apps {

namespace {

nlohmann::json orientation_json(const Eigen::Isometry3d& X) {
  Eigen::Quaterniond q(X.linear());
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  return {{"x", q.x()}, {"y", q.y()}, {"z", q.z()}, {"w", q.w()}};
}

}  // namespace

std::string numbered(const std::string& name, std::size_t number) {
  return name + "_" + std::to_string(number);
}

nlohmann::json time_json(std::chrono::nanoseconds time) {
  constexpr std::int64_t kBillion = 1'000'000'000;
  return {{"sec", time.count() / kBillion}, {"nsec", time.count() % kBillion}};
}

nlohmann::json vector_json(const Eigen::Vector3d& v) {
  return {{"x", v.x()}, {"y", v.y()}, {"z", v.z()}};
}

nlohmann::json color_json(std::string_view name, double opacity) {
  const auto [red, green, blue] = viewer::color(name);
  return {{"r", red}, {"g", green}, {"b", blue}, {"a", opacity}};
}

nlohmann::json pose_json(const Eigen::Isometry3d& X) {
  return {{"position", vector_json(X.translation())}, {"orientation", orientation_json(X)}};
}

nlohmann::json transform_json(std::chrono::nanoseconds time, const std::string& child, const Eigen::Isometry3d& X_WC) {
  return {{"timestamp", time_json(time)},
          {"parent_frame_id", kWorldFrame},
          {"child_frame_id", child},
          {"translation", vector_json(X_WC.translation())},
          {"rotation", orientation_json(X_WC)}};
}

}  // namespace glissade::apps
