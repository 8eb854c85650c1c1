#include <glissade/collision/broad_phase.h>

namespace glissade::collision {

BroadPhase::BroadPhase(std::size_t, double) {}
void BroadPhase::set(std::uint32_t, const Eigen::AlignedBox3d&) {}
void BroadPhase::remove(std::uint32_t) {}
void BroadPhase::update() {}
std::span<const std::uint32_t> BroadPhase::neighbours(std::uint32_t) const {
  return {};
}
std::size_t BroadPhase::pair_count() const {
  return 0;
}

}  // namespace glissade::collision
