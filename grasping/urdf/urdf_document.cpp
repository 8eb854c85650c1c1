#include "urdf/urdf_document.h"

#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>

#include <console_bridge/console.h>
#include <tinyxml.h>
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
  if (!std::filesystem::is_regular_file(path)) throw std::invalid_argument(path.string() + ": there is no such file");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::invalid_argument(path.string() + ": the file cannot be read.");
  return {std::istreambuf_iterator<char>(file), {}};
}

void require(bool holds, const std::filesystem::path& path, const std::string& what) {
  if (!holds) throw std::invalid_argument(path.string() + ": " + what + ".");
}

std::string name_in(const TiXmlElement& joint, const char* role) {
  const TiXmlElement* const link = joint.FirstChildElement(role);
  const char* const name = link ? link->Attribute("link") : nullptr;
  return name ? name : "";
}

/// Each link has one parent, and no link hangs on itself. Checked before liburdfdom makes a model: it takes links with
/// several parents, and the links of a loop would keep each other in memory for ever.
void check_tree(const std::string& text, const std::filesystem::path& path) {
  TiXmlDocument document;
  document.Parse(text.c_str());
  const TiXmlElement* const robot = document.FirstChildElement("robot");
  std::map<std::string, std::string> parents;
  for (const TiXmlElement* joint = robot ? robot->FirstChildElement("joint") : nullptr; joint;
       joint = joint->NextSiblingElement("joint")) {
    const std::string child = name_in(*joint, "child");
    if (child.empty()) continue;  // liburdfdom says so
    require(parents.emplace(child, name_in(*joint, "parent")).second, path,
            "link '" + child + "' is the child of several joints");
  }
  for (const auto& [child, parent] : parents) {
    std::size_t steps = 0;
    for (auto above = parents.find(parent); above != parents.end(); above = parents.find(above->second))
      require(++steps <= parents.size(), path, "link '" + child + "' hangs in a loop, not on the root");
  }
}

}  // namespace

urdf::ModelInterfaceSharedPtr read_urdf_document(const std::filesystem::path& path) {
  static std::mutex one_at_a_time;  // the handler is the process's
  const std::string text = text_of(path);
  check_tree(text, path);
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
  const std::string& why = errors.line().empty() ? thrown : errors.line();
  require(model != nullptr, path, "no valid URDF" + (why.empty() ? "" : ": " + why));
  return model;
}

}  // namespace glissade::grasping
