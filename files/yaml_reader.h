#pragma once

/// Strict typed access to YAML. The message of every error is one line with file, line and key.

#include <span>
#include <string>
#include <string_view>

#include <Eigen/Core>
#include <yaml-cpp/yaml.h>

namespace glissade::files {

/// Reads the nodes of one file. Every function except `where` throws std::invalid_argument, whose message begins with
/// `where(node)`.
class YamlReader {
 public:
  /// `source` is the file's name, for messages.
  explicit YamlReader(std::string source);

  /// The root node of the one document; throws on a syntax error and on a second document.
  YAML::Node parse(const std::string& text);

  /// "file:line" of a node.
  std::string where(const YAML::Node& node) const;

  /// Throws for `node` with the sentence `message`.
  [[noreturn]] void fail(const YAML::Node& node, const std::string& message) const;

  /// Checks that `map` (called `what` in messages) is a map. Its keys must be texts and all different.
  void check_map(const YAML::Node& map, const std::string& what) const;

  /// Like `check_map`; in addition, every key must be one of `known`.
  void check_keys(const YAML::Node& map, const std::string& what, std::span<const std::string_view> known) const;

  /// The value of `key`, which must exist.
  YAML::Node required(const YAML::Node& map, const std::string& what, const std::string& key) const;

  /// The value of `node`: a non-empty text, a finite number, true or false, or a list of `count` finite numbers.
  /// Messages call it `key`.
  std::string text(const YAML::Node& node, const std::string& key) const;
  double number(const YAML::Node& node, const std::string& key) const;
  bool boolean(const YAML::Node& node, const std::string& key) const;
  Eigen::VectorXd numbers(const YAML::Node& node, const std::string& key, std::size_t count) const;

 private:
  std::string source_;
  std::string text_;
};

}  // namespace glissade::files
