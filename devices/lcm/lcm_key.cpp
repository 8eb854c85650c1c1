#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>

#include <sys/stat.h>

#include <glissade/devices/lcm_bus.h>

namespace glissade::devices {

LcmKey read_lcm_key(const std::string& path) {
  const auto refuse = [&path](const std::string& reason) { throw std::invalid_argument(path + ": " + reason); };
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) {
    if (errno == ENOENT) refuse("there is no such file");
    refuse(std::string("the key cannot be read: ") + std::strerror(errno));
  }
  if ((status.st_mode & (S_IRWXG | S_IRWXO)) != 0) {
    refuse("others may read or change the key; only its owner should (chmod 600)");
  }
  std::ifstream file(path, std::ios::binary);
  std::string text(2 * sizeof(LcmKey::bytes) + 2, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.ends_with('\n')) text.pop_back();

  LcmKey key;
  if (text.size() != 2 * key.bytes.size()) refuse("a key is one line of 64 hexadecimal digits");
  for (std::size_t i = 0; i < key.bytes.size(); ++i) {
    const char* const digits = text.data() + 2 * i;
    const auto [end, error] = std::from_chars(digits, digits + 2, key.bytes[i], 16);
    if (error != std::errc{} || end != digits + 2) refuse("a key is one line of 64 hexadecimal digits");
  }
  return key;
}

}  // namespace glissade::devices
