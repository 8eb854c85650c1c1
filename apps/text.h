#pragma once

/// The program reads and writes as the library does: it uses the names of `glissade/files` as its own.

#include <glissade/files/did_you_mean.h>
#include <glissade/files/text.h>

namespace glissade::apps {

using namespace files;

}  // namespace glissade::apps
