#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <mutex>
#include <set>
#include <stdexcept>
#include <system_error>

#include <unistd.h>

#include <glissade/files/file_checks.h>
#include <glissade/files/text.h>

namespace glissade::files {

namespace {

using std::filesystem::file_type;

struct InputFiles {
  std::mutex mutex;
  std::set<std::filesystem::path> paths;
};

InputFiles& input_files() {
  static InputFiles files;
  return files;
}

/// At the end of all links. Throws where that cannot be told, such as for links in a loop.
file_type type_of(const std::string& path) {
  if (path.empty()) throw std::invalid_argument("the name of a file is empty");
  std::error_code error;
  const file_type type = std::filesystem::status(path, error).type();
  if (type == file_type::none) throw std::invalid_argument(path + ": " + error.message());
  return type;
}

std::string folder_of(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

bool is_input(const std::string& path) {
  const std::lock_guard lock(input_files().mutex);
  const auto& paths = input_files().paths;
  return std::any_of(paths.begin(), paths.end(), [&](const std::filesystem::path& input) {
    std::error_code ignored;
    return std::filesystem::equivalent(input, path, ignored);  // by device and inode
  });
}

/// Whether two names are those of one file, perhaps one that is still to be written.
bool are_one_file(const std::string& one, const std::string& other) {
  if (one == other) return true;
  if (one == "-" || other == "-") return false;
  std::error_code error;
  if (std::filesystem::equivalent(one, other, error)) return true;
  const auto whole = [&error](const std::string& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path, error), error);
  };
  const std::filesystem::path first = whole(one);
  return !first.empty() && first == whole(other);
}

}  // namespace

void check_input(const std::string& path) {
  const file_type type = type_of(path);
  if (type == file_type::not_found) throw std::invalid_argument(path + ": there is no such file");
  // A folder opens like a file and fails only later, with a less helpful reason. A pipe or a device may never end.
  if (type == file_type::directory) throw std::invalid_argument(path + ": is a folder, not a file");
  if (type != file_type::regular) throw std::invalid_argument(path + ": is not a regular file");
  std::error_code ignored;
  std::filesystem::path whole = std::filesystem::weakly_canonical(path, ignored);
  const std::lock_guard lock(input_files().mutex);
  input_files().paths.insert(std::move(whole));
}

void check_output(const std::string& path) {
  const file_type type = type_of(path);
  if (type == file_type::directory) throw std::invalid_argument(path + ": is a folder, not a file");
  if (type == file_type::not_found && type_of(folder_of(path)) != file_type::directory)
    throw std::invalid_argument(path + ": cannot be created: there is no folder " + in_quotes(folder_of(path)));
  if (is_input(path)) throw std::invalid_argument(path + ": is an input, which would be overwritten");
}

std::ofstream open_output(const std::string& path) {
  check_output(path);
  std::ofstream file(path, std::ios::binary);
  if (!file) throw std::invalid_argument(path + ": cannot be written: " + std::generic_category().message(errno));
  return file;
}

void check_recording(const std::string& path, bool overwrites) {
  check_output(path);
  const file_type type = type_of(path);
  if (type == file_type::fifo || type == file_type::socket)
    throw std::invalid_argument(path + ": is a pipe; a recording needs a file, because a run cannot wait for a reader");
  if (type == file_type::regular && !overwrites)
    throw std::invalid_argument(path + ": is there already, and is replaced only with --overwrite");
  const bool is_new = type == file_type::not_found;
  if (access((is_new ? folder_of(path) : path).c_str(), is_new ? W_OK | X_OK : W_OK) == 0) return;
  throw std::invalid_argument(path + ": cannot be created: " + std::generic_category().message(errno));
}

void check_distinct(const std::vector<std::pair<std::string, std::string>>& outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const auto& [option, path] = outputs[i];
      if (path.empty() || outputs[j].second.empty() || !are_one_file(path, outputs[j].second)) continue;
      throw std::invalid_argument(option + ": " + in_quotes(path) + " is already the file of " + outputs[j].first);
    }
  }
}

}  // namespace glissade::files
