// Compiled by a test, never linked. Without FORGED it compiles; with each number of FORGED it must not: nothing but a
// `SafetyEnvelope` makes a command that a device takes.

#include <glissade/devices/lcm_glove.h>
#include <glissade/devices/safety_envelope.h>
#include <glissade/devices/simulated_glove.h>

namespace glissade::devices {

void try_to_forge(GloveDevice& device, SimulatedGlove& glove, const GloveCommand& wanted) {
#if !defined(FORGED)
  SafetyEnvelope envelope(device.descriptor());
  device.command(envelope.limit(wanted, GloveState{}, std::chrono::nanoseconds(0)));
#elif FORGED == 1
  device.command(wanted);
#elif FORGED == 2
  device.command(SafeCommand{wanted});
#elif FORGED == 3
  SafeCommand safe;
  safe.values_ = wanted;
#elif FORGED == 4
  SafeCommand safe;
  safe.values().f_H_W = wanted.f_H_W;
#elif FORGED == 5
  glove.step(std::chrono::milliseconds(1), wanted);
#endif
  (void)glove;
}

}  // namespace glissade::devices
