#pragma once

/// A folder for the files of one test.

#include <filesystem>
#include <string>

namespace glissade::test_support {

/// A new empty folder. The destructor deletes it with its content. Throws std::filesystem::filesystem_error.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  /// The full path of `name` in the folder.
  std::string path(const std::string& name) const { return (path_ / name).string(); }

  /// Writes `text` to the file `name` and returns its full path.
  std::string write(const std::string& name, const std::string& text) const;

 private:
  std::filesystem::path path_;
};

}  // namespace glissade::test_support
