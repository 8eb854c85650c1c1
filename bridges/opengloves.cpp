#include <algorithm>

#include <glissade/bridges/opengloves.h>

#include "hand/finger_curls.h"

namespace glissade::bridges {

devices::GloveModel opengloves_model() {
  return devices::read_glove_model("opengloves");
}

devices::DeviceDescriptor opengloves_descriptor() {
  const devices::GloveModel model = opengloves_model();
  devices::DeviceDescriptor descriptor = devices::descriptor_of(model);
  constexpr double kDeviations = 2.0;  // hardly any noise is larger
  descriptor.joint_resolution = std::max(descriptor.joint_resolution, kDeviations * model.sensor.noise);
  descriptor.resolution = 0.0;  // the glove measures the fingers only
  descriptor.joint_lower = lower_angles();
  descriptor.joint_upper = upper_angles();
  return descriptor;
}

}  // namespace glissade::bridges
