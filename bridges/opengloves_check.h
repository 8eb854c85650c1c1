#pragma once

/// Checks the wire to an OpenGloves glove, and reports in sentences for people.

#include <chrono>
#include <functional>
#include <string>

#include <glissade/bridges/opengloves_wire.h>

namespace glissade::bridges {

/// Opens the port, listens for some seconds, leaves all fingers free, and closes the port. `say` receives a sentence
/// for each finding: the port, the encoding, the rate, first numbers and warnings. Ends early when `goes_on` returns
/// false. Returns whether a bridge can work with the glove. Throws what `SerialStream` throws at its construction.
bool check_opengloves(const OpenGlovesOptions& options, const std::function<bool()>& goes_on,
                      const std::function<void(const std::string&)>& say);

}  // namespace glissade::bridges
