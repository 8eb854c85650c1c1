#pragma once

#include <glissade/simulation/simulation.h>

#include "guarded.h"

namespace glissade::python {

using GuardedSimulation = Guarded<simulation::Simulation>;

}  // namespace glissade::python
