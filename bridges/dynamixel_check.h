#pragma once

/// Checks the wire to a glove of Dynamixel servos, and reports in sentences for people.

#include <functional>
#include <string>

#include <glissade/bridges/dynamixel_hand.h>

namespace glissade::bridges {

/// Opens the port of the bus and, if the hand has measured joints, the port of the measuring board. Talks to all
/// servos, and leaves their torque off. Changes no setting. `say` receives a sentence for each finding: ports, servos
/// that answer or do not, the baud rate and ids with which they answer instead, models, firmware, settings, angles, the
/// time of a measurement, and the board. Ends early when `goes_on` returns false. Returns whether a bridge can work
/// with the glove. Throws what `validate` throws for the hand, and what `SerialStream` throws at its construction.
bool check_dynamixel(const DynamixelHand& hand, const std::string& port, const std::function<bool()>& goes_on,
                     const std::function<void(const std::string&)>& say);

}  // namespace glissade::bridges
