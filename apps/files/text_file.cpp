#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include <glissade/apps/files/file_checks.h>
#include <glissade/apps/files/text_file.h>

namespace glissade::apps {

std::ifstream open_text_file(const std::string& path, std::uintmax_t max_bytes) {
  check_input(path);
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::invalid_argument(path + ": " + std::generic_category().message(errno));
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  if (size > max_bytes) {
    throw std::invalid_argument(path + ": has " + std::to_string(size) + " bytes; at most " +
                                std::to_string(max_bytes) + " are read");
  }
  return file;
}

std::string read_text_file(const std::string& path, std::uintmax_t max_bytes) {
  std::ifstream file = open_text_file(path, max_bytes);
  std::error_code ignored;
  std::string text(std::filesystem::file_size(path, ignored), '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) throw std::invalid_argument(path + ": cannot be read");
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

}  // namespace glissade::apps
