#include "stream/baud_rate.h"

#include <algorithm>
#include <cmath>

// These headers of the kernel and <termios.h> exclude each other.
#include <asm/ioctls.h>
#include <asm/termbits.h>
#include <sys/ioctl.h>

namespace glissade::bridges {

bool set_baud_rate(int descriptor, unsigned baud_rate) noexcept {
  termios2 settings{};
  if (ioctl(descriptor, TCGETS2, &settings) != 0) return false;
  settings.c_cflag &= ~static_cast<tcflag_t>(CBAUD | (CBAUD << IBSHIFT));
  settings.c_cflag |= BOTHER | (BOTHER << IBSHIFT);
  settings.c_ospeed = settings.c_ispeed = baud_rate;
  if (ioctl(descriptor, TCSETS2, &settings) != 0) return false;
  constexpr double kTolerance = 0.03;
  return std::abs(bridges::baud_rate(descriptor) - static_cast<double>(baud_rate)) <= kTolerance * baud_rate;
}

unsigned baud_rate(int descriptor) noexcept {
  termios2 settings{};
  return ioctl(descriptor, TCGETS2, &settings) == 0 ? settings.c_ospeed : 0;
}

}  // namespace glissade::bridges
