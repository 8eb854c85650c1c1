#include <algorithm>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/eventhandler.h>

#include <glissade/files/did_you_mean.h>
#include <glissade/files/text.h>
#include <glissade/files/yaml_reader.h>

namespace glissade::files {

namespace {

std::string at_mark(const std::string& source, const YAML::Mark& mark) {
  return mark.is_null() ? source : source + ":" + std::to_string(mark.line + 1);
}

/// The line, from 0, of the last thing before the mark that is not empty.
int last_line_before(const std::string& text, const YAML::Mark& mark) {
  int line = 0;
  int last = 0;
  int column = 0;
  bool is_comment = false;
  for (const char c : text) {
    if (line > mark.line || (line == mark.line && column >= mark.column)) break;
    is_comment = is_comment || c == '#';
    if (!is_comment && c != ' ' && c != '\r' && c != '\n') last = line;
    ++column;
    if (c != '\n') continue;
    ++line;
    column = 0;
    is_comment = false;
  }
  return last;
}

std::string shown(const YAML::Node& node) {
  if (node.IsScalar()) return in_quotes(node.Scalar());
  if (node.IsMap()) return "a map";
  return node.IsSequence() ? "a list" : "nothing";
}

/// Where documents begin.
class DocumentStarts : public YAML::EventHandler {
 public:
  std::vector<YAML::Mark> marks;

  void OnDocumentStart(const YAML::Mark& mark) override { marks.push_back(mark); }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}
};

/// Not all documents: yaml-cpp 0.7 finds endlessly many where a comma stands outside of a list.
DocumentStarts first_two_starts(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  DocumentStarts starts;
  while (starts.marks.size() < 2 && parser.HandleNextDocument(starts)) {
  }
  return starts;
}

}  // namespace

YamlReader::YamlReader(std::string source) : source_(std::move(source)) {}

YAML::Node YamlReader::parse(const std::string& text) {
  text_ = text;
  try {
    const DocumentStarts starts = first_two_starts(text);
    if (starts.marks.size() < 2) return YAML::Load(text);
    throw std::invalid_argument(at_mark(source_, starts.marks[1]) +
                                ": a second YAML document begins here, but there must be only one");
  } catch (const YAML::DeepRecursion& error) {
    throw std::invalid_argument(at_mark(source_, error.mark) + ": not valid YAML: lists or maps in more than " +
                                std::to_string(error.depth()) + " others");
  } catch (const YAML::Exception& error) {
    throw std::invalid_argument(at_mark(source_, error.mark) + ": not valid YAML: " + error.msg);
  }
}

std::string YamlReader::where(const YAML::Node& node) const {
  YAML::Mark mark = node.Mark();
  // The mark of an empty value is where the next thing begins, often some lines below.
  if (node.IsNull()) mark.line = last_line_before(text_, mark);
  return at_mark(source_, mark);
}

void YamlReader::fail(const YAML::Node& node, const std::string& message) const {
  throw std::invalid_argument(where(node) + ": " + message);
}

void YamlReader::check_map(const YAML::Node& map, const std::string& what) const {
  if (!map.IsMap()) fail(map, what + " must be a map of keys and values, not " + shown(map));
  std::set<std::string> seen;
  for (const auto& entry : map) {
    if (!entry.first.IsScalar()) fail(entry.first, what + ": a key must be text, not " + shown(entry.first));
    const std::string& key = entry.first.Scalar();
    if (!seen.insert(key).second) fail(entry.first, what + ": the key " + in_quotes(key) + " is given twice");
  }
}

void YamlReader::check_keys(const YAML::Node& map, const std::string& what,
                            std::span<const std::string_view> known) const {
  check_map(map, what);
  for (const auto& entry : map) {
    const std::string& key = entry.first.Scalar();
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      fail(entry.first, what + ": unknown key " + in_quotes(key) + did_you_mean(key, {known.begin(), known.end()}) +
                            " (known: " + joined(known) + ")");
    }
  }
}

YAML::Node YamlReader::required(const YAML::Node& map, const std::string& what, const std::string& key) const {
  YAML::Node node = map[key];
  if (!node) fail(map, what + ": the key " + in_quotes(key) + " is missing");
  return node;
}

std::string YamlReader::text(const YAML::Node& node, const std::string& key) const {
  if (!node.IsScalar() || node.Scalar().empty()) fail(node, key + ": must be a text, not " + shown(node));
  return node.Scalar();
}

double YamlReader::number(const YAML::Node& node, const std::string& key) const {
  const std::optional<double> value = node.IsScalar() ? parse_number(node.Scalar()) : std::nullopt;
  if (!value) fail(node, key + ": must be a finite number, not " + shown(node));
  return *value;
}

bool YamlReader::boolean(const YAML::Node& node, const std::string& key) const {
  const std::string value = node.IsScalar() ? node.Scalar() : "";
  if (value != "true" && value != "false") fail(node, key + ": must be true or false, not " + shown(node));
  return value == "true";
}

Eigen::VectorXd YamlReader::numbers(const YAML::Node& node, const std::string& key, std::size_t count) const {
  if (!node.IsSequence())
    fail(node, key + ": must be a list of " + std::to_string(count) + " numbers, not " + shown(node));
  if (node.size() != count) {
    fail(node,
         key + ": must be a list of " + std::to_string(count) + " numbers, not of " + std::to_string(node.size()));
  }
  Eigen::VectorXd values(static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i)
    values[static_cast<Eigen::Index>(i)] = number(node[i], key);
  return values;
}

}  // namespace glissade::files
