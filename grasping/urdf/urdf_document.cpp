#include "urdf/urdf_document.h"

#include <fstream>
#include <iterator>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

namespace glissade::grasping {
namespace {

/// liburdfdom logs its errors: first what is wrong, then the joint or link where it is. Keeps them, as one line,
/// instead of printing them.
class Errors : public console_bridge::OutputHandler {
 public:
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level < console_bridge::CONSOLE_BRIDGE_LOG_ERROR) return;
    line_ += (line_.empty() ? "" : "; ") + text.substr(0, text.find('\n'));
  }
  const std::string& line() const { return line_; }

 private:
  std::string line_;
};

std::string text_of(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path)) throw std::invalid_argument(path.string() + ": there is no such file.");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::invalid_argument(path.string() + ": the file cannot be read.");
  return {std::istreambuf_iterator<char>(file), {}};
}

urdf::ModelInterfaceSharedPtr parse(const std::filesystem::path& path) {
  static std::mutex one_at_a_time;  // the handler is the process's
  const std::string text = text_of(path);
  const std::lock_guard lock(one_at_a_time);
  Errors errors;
  console_bridge::OutputHandler* const before = console_bridge::getOutputHandler();
  console_bridge::useOutputHandler(&errors);
  urdf::ModelInterfaceSharedPtr model;
  std::string thrown;
  try {
    model = urdf::parseURDF(text);
  } catch (const std::exception& exception) {
    thrown = exception.what();
  }
  console_bridge::useOutputHandler(before);
  if (model) return model;
  const std::string& why = errors.line().empty() ? thrown : errors.line();
  throw std::invalid_argument(path.string() + ": no valid URDF" + (why.empty() ? "." : ": " + why));
}

void add_descendants(const urdf::Link& link, const std::filesystem::path& path, std::set<std::string>& found) {
  if (!found.insert(link.name).second)
    throw std::invalid_argument(path.string() + ": link '" + link.name + "' is the child of several joints.");
  for (const urdf::LinkSharedPtr& child : link.child_links)
    add_descendants(*child, path, found);
}

}  // namespace

urdf::ModelInterfaceSharedPtr read_urdf_document(const std::filesystem::path& path) {
  const urdf::ModelInterfaceSharedPtr model = parse(path);
  std::set<std::string> found;
  add_descendants(*model->getRoot(), path, found);
  for (const auto& [name, link] : model->links_)
    if (!found.contains(name))
      throw std::invalid_argument(path.string() + ": link '" + name + "' hangs in a loop, not on the root.");
  return model;
}

}  // namespace glissade::grasping
