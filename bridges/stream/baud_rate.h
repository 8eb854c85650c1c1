#pragma once

/// The baud rate of a serial port, as a number. The constants of termios name some rates only.

namespace glissade::bridges {

/// Returns whether the port has this rate afterwards, to within 3 %: with more, a byte of ten bits is read wrongly.
/// `descriptor` is that of an open port.
bool set_baud_rate(int descriptor, unsigned baud_rate) noexcept;

/// The rate of the port; 0 if it is none.
unsigned baud_rate(int descriptor) noexcept;

}  // namespace glissade::bridges
