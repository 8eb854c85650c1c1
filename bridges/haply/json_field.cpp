#include "haply/json_field.h"

#include <stdexcept>
#include <utility>

namespace glissade::bridges {

JsonField JsonField::at(std::string_view key) const {
  if (std::optional<JsonField> found = find(key)) return *std::move(found);
  refuse("has no key '" + std::string(key) + "'");
}

JsonField JsonField::at(std::size_t index) const {
  if (index >= list_size()) refuse("has too few values");
  return {(*value_)[index], path_ + "[" + std::to_string(index) + "]"};
}

std::optional<JsonField> JsonField::find(std::string_view key) const {
  if (!value_->is_object()) refuse("is no object");
  const auto found = value_->find(key);
  if (found == value_->end()) return std::nullopt;
  return JsonField(*found, path_.empty() ? std::string(key) : path_ + "." + std::string(key));
}

double JsonField::number() const {
  if (!value_->is_number()) refuse("is no number");
  return value_->get<double>();
}

bool JsonField::flag() const {
  if (!value_->is_boolean()) refuse("is neither true nor false");
  return value_->get<bool>();
}

std::string JsonField::text() const {
  if (!value_->is_string()) refuse("is no text");
  return value_->get<std::string>();
}

std::size_t JsonField::list_size() const {
  if (!value_->is_array()) refuse("is no list");
  return value_->size();
}

void JsonField::refuse(std::string_view what) const {
  throw std::invalid_argument((path_.empty() ? "the message" : path_) + " " + std::string(what));
}

}  // namespace glissade::bridges
