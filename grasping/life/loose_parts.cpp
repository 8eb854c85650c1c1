#include "life/loose_parts.h"

#include <cstdint>

#include <glissade/geometry/displacement.h>

namespace glissade::grasping {

Eigen::Isometry3d LooseParts::push(std::size_t p, double milliseconds, contact::MultiPartSliding& sliding) {
  const contact::SlidingPart& part = sliding.part(p);
  const geometry::Displacement d = pushes_[p].displacement(part.radius(), milliseconds);
  if (d.is_zero()) {
    stop(p, sliding);
    return sliding.result(p).X_WV;
  }
  if (!is_pushed_[p]) sliding.grasp(p, sliding.result(p).X_WV);
  is_pushed_[p] = 1;
  const contact::SlidingResult& result = sliding.result(p);
  const bool repeats_motion = !traits_of(metaphors_[p]).makes_up;
  return geometry::displaced(repeats_motion ? result.X_WG : result.X_WV, sliding.p_Vref(p), d);
}

void LooseParts::end_push(std::size_t p, contact::MultiPartSliding& sliding) {
  stop(p, sliding);
  pushes_[p].clear();
}

void LooseParts::stop(std::size_t p, contact::MultiPartSliding& sliding) {
  if (is_pushed_[p]) sliding.release(p);
  is_pushed_[p] = 0;
}

void LooseParts::look(std::size_t p, std::span<const GraspingHand> hands, const contact::MultiPartSliding& sliding) {
  pushes_[p].clear();
  if (sliding.is_scripted(p)) return;
  const auto body = static_cast<std::int32_t>(sliding.obstacle_count() + p);
  for (const GraspingHand& hand : hands) {
    if (!hand.is_lost() && !hand.is_late() && !hand.closes_round(body) && !hand.has_just_left(p))
      pushes_[p].add(hand, body, sliding.result(p).X_WV, sliding.part(p));
  }
}

}  // namespace glissade::grasping
