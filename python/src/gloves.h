#pragma once

/// The gloves of Python, as a server uses them.

#include <memory>
#include <stdexcept>
#include <string>

#include <glissade/devices/glove_device.h>

#include "running.h"

namespace glissade::python {

class Glove : public Running {
 public:
  /// The server's end. Throws std::runtime_error if the glove has ended with the program.
  virtual devices::GloveDevice& device() = 0;

  /// Makes the glove busy for as long as the result lives. Throws std::invalid_argument if it is.
  std::shared_ptr<void> claim(const std::string& name) {
    if (!claim_.expired()) throw std::invalid_argument(name + " is in use by a server");
    const auto claim = std::make_shared<int>();
    claim_ = claim;
    return claim;
  }

 private:
  std::weak_ptr<void> claim_;
};

/// The names of the reasons, the most serious first.
pybind11::tuple names_of(const devices::LimitReasons& reasons);

}  // namespace glissade::python
