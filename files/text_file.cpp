#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include <glissade/files/file_checks.h>
#include <glissade/files/text_file.h>

namespace glissade::files {

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

void write_new_files(const std::vector<TextFile>& files) {
  std::vector<const TextFile*> missing;
  std::error_code ignored;  // check_output tells what is wrong
  for (const TextFile& file : files) {
    if (!std::filesystem::exists(file.path, ignored)) {
      check_output(file.path);
      missing.push_back(&file);
    } else if (read_text_file(file.path) != file.text) {
      throw std::invalid_argument(file.path + ": is there already, with another content; name another folder");
    }
  }
  for (const TextFile* file : missing) {
    std::ofstream out = open_output(file->path);
    out << file->text << std::flush;
    if (!out) throw std::runtime_error(file->path + ": not everything could be written");
  }
}

}  // namespace glissade::files
