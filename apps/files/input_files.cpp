#include <algorithm>
#include <filesystem>
#include <mutex>
#include <stdexcept>
#include <vector>

#include <glissade/apps/files/input_files.h>

namespace glissade::apps {
namespace {

struct InputFiles {
  std::mutex mutex;
  std::vector<std::filesystem::path> paths;
};

InputFiles& input_files() {
  static InputFiles files;
  return files;
}

}  // namespace

void note_input(const std::string& path) {
  std::error_code ignored;
  const std::filesystem::path whole = std::filesystem::weakly_canonical(path, ignored);
  const std::lock_guard lock(input_files().mutex);
  input_files().paths.push_back(whole);
}

void refuse_input(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return;
  const std::lock_guard lock(input_files().mutex);
  const auto& paths = input_files().paths;
  const bool is_input = std::any_of(paths.begin(), paths.end(), [&](const std::filesystem::path& input) {
    return std::filesystem::equivalent(input, path, ignored);
  });
  if (is_input) throw std::invalid_argument(path + ": is an input, which would be overwritten");
}

}  // namespace glissade::apps
