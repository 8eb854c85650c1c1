#include "objects.h"

namespace glissade::c {

Handles<SceneObject>& scenes() {
  static auto& handles = *new Handles<SceneObject>("scene");
  return handles;
}

Handles<SimulationObject>& simulations() {
  static auto& handles = *new Handles<SimulationObject>("simulation");
  return handles;
}

Handles<GloveObject>& gloves() {
  static auto& handles = *new Handles<GloveObject>("glove");
  return handles;
}

Handles<ServerObject>& servers() {
  static auto& handles = *new Handles<ServerObject>("server");
  return handles;
}

}  // namespace glissade::c
