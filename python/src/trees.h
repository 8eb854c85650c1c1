#pragma once

#include <memory>
#include <string>

#include <pybind11/pybind11.h>

#include <glissade/collision/dop_tree.h>

namespace glissade::python {

/// A tree from an argument. Throws pybind11::type_error with the name of the argument for anything else. The sentence
/// about a mesh says that it needs a tree.
std::shared_ptr<collision::DopTree> tree_from(const pybind11::object& argument, const std::string& name);

}  // namespace glissade::python
