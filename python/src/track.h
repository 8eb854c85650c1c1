#pragma once

/// A simulation along a path, in one call, and the table of what happened.

#include <optional>

#include <pybind11/numpy.h>

#include "guarded_simulation.h"

namespace glissade::python {

/// One row for each pose of the path. With an axis for the parts if the path or the scene has several.
struct Track {
  pybind11::array X_WG;
  pybind11::array X_WV;
  pybind11::array f_W;
  pybind11::array t_W;
  pybind11::array state;
  pybind11::array pushing;
  std::optional<pybind11::array> clearance;
};

Track follow(GuardedSimulation& guarded, const pybind11::object& X_WG, double milliseconds, bool with_clearance);
Track follow_hands(GuardedSimulation& guarded, const pybind11::object& X_WR, const pybind11::object& angles,
                   double milliseconds);

void add_track(pybind11::module_& module);

}  // namespace glissade::python
