#include <algorithm>
#include <filesystem>
#include <fstream>

#include <grp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <glissade/bridges/serial_ports.h>

namespace glissade::bridges {
namespace {

namespace fs = std::filesystem;

std::string first_line(const fs::path& file) {
  std::string line;
  std::getline(std::ifstream(file) >> std::ws, line);
  return line;
}

/// The name of the device behind a port, from the nearest folder of the system that has one.
std::string device_of(const fs::path& root, const std::string& name) {
  std::error_code none;
  fs::path folder = fs::canonical(root / "sys/class/tty" / name / "device", none);
  constexpr int kHighest = 4;  // port, interface, device
  for (int i = 0; !none && i < kHighest && folder.has_relative_path(); ++i, folder = folder.parent_path()) {
    const std::string product = first_line(folder / "product");
    if (product.empty()) continue;
    const std::string maker = first_line(folder / "manufacturer");
    return maker.empty() ? product : maker + " " + product;
  }
  return name.starts_with("rfcomm") ? "Bluetooth" : "";
}

/// The link in dev/serial/by-id to a port.
std::string lasting_path(const fs::path& root, const fs::path& port) {
  std::error_code none;
  for (const fs::directory_entry& link : fs::directory_iterator(root / "dev/serial/by-id", none)) {
    std::error_code broken;
    if (fs::equivalent(link.path(), port, broken)) return link.path().string();
  }
  return {};
}

std::string group_of(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return {};
  const group* const owner = getgrgid(status.st_gid);
  return owner ? owner->gr_name : std::to_string(status.st_gid);
}

}  // namespace

std::string port_trouble(const std::string& path, std::errc error) {
  switch (error) {
    case std::errc::no_such_file_or_directory:
      return path + ": there is no such port; is the device plugged in and on? --list shows the ports of this machine";
    case std::errc::permission_denied:
      return path + ": this user has no right to open the port; it belongs to the group '" + group_of(path) +
             "': 'sudo usermod -aG " + group_of(path) + " $USER', and log in again";
    case std::errc::device_or_resource_busy:
      return path + ": another program uses the port";
    case std::errc::inappropriate_io_control_operation:
      return path + ": this is no serial port";
    default:
      return path + ": the port cannot be opened: " + std::make_error_code(error).message();
  }
}

std::vector<SerialPort> serial_ports(const std::string& root) {
  std::vector<SerialPort> ports;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(root) / "dev", none)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("ttyUSB") && !name.starts_with("ttyACM") && !name.starts_with("rfcomm")) continue;
    SerialPort& port = ports.emplace_back();
    port.path = entry.path().string();
    port.lasting = lasting_path(root, entry.path());
    port.device = device_of(root, name);
    if (access(port.path.c_str(), R_OK | W_OK) != 0)
      port.trouble = port_trouble(port.path, static_cast<std::errc>(errno));
  }
  std::sort(ports.begin(), ports.end(), [](const SerialPort& a, const SerialPort& b) { return a.path < b.path; });
  return ports;
}

}  // namespace glissade::bridges
