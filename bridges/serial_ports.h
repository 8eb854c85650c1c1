#pragma once

/// Lists the serial ports of this machine, and explains errors of a port.

#include <string>
#include <system_error>
#include <vector>

namespace glissade::bridges {

struct SerialPort {
  std::string path;     ///< such as "/dev/ttyUSB0"
  std::string lasting;  ///< a path that stays the same when the device is plugged in again; empty if there is none
  std::string device;   ///< what the device calls itself, such as "Silicon Labs CP2102"; empty if it says nothing
  std::string trouble;  ///< why this user cannot open the port; empty if nothing is known against it
};

/// Ports of USB adapters (ttyUSB, ttyACM) and of Bluetooth devices (rfcomm), by their paths. Opens none of them.
/// `root` is the folder that has `dev` and `sys`; tests use another one.
std::vector<SerialPort> serial_ports(const std::string& root = "/");

/// A sentence on an error at the opening of a port: what is wrong, and what helps.
std::string port_trouble(const std::string& path, std::errc error);

}  // namespace glissade::bridges
