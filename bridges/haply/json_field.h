#pragma once

/// Strict reading of JSON, with errors that name the key.

#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace glissade::bridges {

/// A value in a JSON document, with its path such as `inverse3[0].state.cursor_position.x`. All functions throw
/// std::invalid_argument with the path if the value, or one on the way to it, is missing or of another type. The
/// document must outlive the field.
class JsonField {
 public:
  explicit JsonField(const nlohmann::json& root) : value_(&root) {}

  JsonField at(std::string_view key) const;
  JsonField at(std::size_t index) const;
  /// No value if the object does not have this key.
  std::optional<JsonField> find(std::string_view key) const;

  double number() const;
  bool flag() const;
  std::string text() const;
  /// The number of values in a list.
  std::size_t list_size() const;

  /// Throws std::invalid_argument: the path, and what is wrong with the value.
  [[noreturn]] void refuse(std::string_view what) const;

 private:
  JsonField(const nlohmann::json& value, std::string path) : value_(&value), path_(std::move(path)) {}

  const nlohmann::json* value_;
  std::string path_;
};

}  // namespace glissade::bridges
