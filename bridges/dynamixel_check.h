#pragma once

/// What is wrong with the wire to a glove of Dynamixel servos, in sentences for people.

#include <functional>
#include <string>

#include <glissade/bridges/dynamixel_hand.h>

namespace glissade::bridges {

/// Opens the port of the bus, and that of the measuring board if the hand has measured joints; talks to all servos, and
/// leaves their torque off. Changes no setting. `say` receives a sentence for each finding: ports, servos that answer
/// or do not, at which baud rate and under which ids they answer instead, models, firmware, settings, angles, the time
/// of a measurement, and the board. Ends early when `goes_on` returns false. Returns whether a bridge can work with the
/// glove. Throws what `validate` throws for the hand, and what `SerialStream` throws at its construction.
bool check_dynamixel(const DynamixelHand& hand, const std::string& port, const std::function<bool()>& goes_on,
                     const std::function<void(const std::string&)>& say);

}  // namespace glissade::bridges
