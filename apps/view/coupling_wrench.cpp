#include <glissade/apps/view/coupling_wrench.h>

namespace glissade::apps {
namespace {

/// A part that lags without a contact that pushes, as after a jump of the hand, only needs time to follow.
haptics::Wrench wrench_of(const haptics::SlidingResult& result, const haptics::CouplingStiffness& stiffness,
                          const geometry::Displacement& error, const Eigen::Vector3d& p_Vref) {
  if (result.pushing == 0) return {};
  return haptics::about_point(haptics::spring_wrench(stiffness, error), result.X_WT * p_Vref, result.X_WV * p_Vref);
}

}  // namespace

haptics::Wrench wrench_about_reference(const haptics::SlidingSimulation& sliding) {
  return wrench_of(sliding.result(), sliding.stiffness(), sliding.error(), sliding.part().p_Vref());
}

haptics::Wrench wrench_about_reference(const haptics::MultiPartSliding& parts, std::size_t part) {
  return wrench_of(parts.result(part), parts.stiffness(part), parts.error(part), parts.p_Vref(part));
}

}  // namespace glissade::apps
