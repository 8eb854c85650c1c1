#include <array>

#include <glissade/haptics/loop_simulation.h>

namespace glissade::haptics {

void PartsInLoop::advance(const Ghosts& ghosts, double milliseconds) {
  std::array<Eigen::Isometry3d, contact::kMaxParts> X_WG;
  for (std::size_t p = 0; p < parts_.part_count(); ++p)
    X_WG[p] = ghosts.parts[p].X_WG;
  parts_.advance({X_WG.data(), parts_.part_count()}, milliseconds);
}

}  // namespace glissade::haptics
