#include <cmath>
#include <stdexcept>

#include <glissade/contact/spring.h>

namespace glissade::contact {

CouplingStiffness stiffness_of_part(double radius, double translational) {
  const double usual = kUsualStiffness_N_per_m * radius * radius;
  return {translational, translational / kUsualStiffness_N_per_m * usual};
}

void validate(const CouplingStiffness& stiffness, const std::string& part_name) {
  const auto is_stiffness = [](double k) { return k > 0.0 && std::isfinite(k); };
  if (is_stiffness(stiffness.translational) && is_stiffness(stiffness.rotational)) return;
  throw std::invalid_argument("the stiffness with which " + part_name + " is held is not a positive number");
}

Wrench about_point(const Wrench& wrench, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return {wrench.f, wrench.t + (from - to).cross(wrench.f)};
}

Wrench spring_wrench(const CouplingStiffness& stiffness, const geometry::Displacement& error) {
  return {-stiffness.translational * error.v, -stiffness.rotational * error.w};
}

}  // namespace glissade::contact
