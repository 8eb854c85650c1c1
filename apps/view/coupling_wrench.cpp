#include <glissade/apps/view/coupling_wrench.h>

namespace glissade::apps {

haptics::Wrench wrench_about_origin(const haptics::SlidingSimulation& sliding) {
  const haptics::SlidingResult& result = sliding.result();
  return haptics::about_point(haptics::spring_wrench(sliding.stiffness(), sliding.error()),
                              result.X_WT * sliding.part().p_Vref(), result.X_WV.translation());
}

haptics::Wrench wrench_about_origin(const haptics::MultiPartSliding& parts, std::size_t part) {
  const haptics::SlidingResult& result = parts.result(part);
  return haptics::about_point(haptics::spring_wrench(parts.stiffness(part), parts.error(part)),
                              result.X_WT * parts.p_Vref(part), result.X_WV.translation());
}

}  // namespace glissade::apps
