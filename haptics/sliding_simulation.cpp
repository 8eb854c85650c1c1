#include <glissade/haptics/sliding_simulation.h>

namespace glissade::haptics {

geometry::Displacement SlidingSimulation::error() const {
  return geometry::displacement_between(result().X_WV, result().X_WT, part().p_Vref());
}

}  // namespace glissade::haptics
