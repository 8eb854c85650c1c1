#pragma once

/// Manual pages of the commands, made of what the parser knows about them.

#include <string>

namespace CLI {
class App;
}

namespace glissade::apps {

/// The manual page of a command, section 1, as source of man(7). `name` has all words of the command, such as
/// "glissade bridge haply".
std::string man_page(const CLI::App& command, const std::string& name, const std::string& version);

}  // namespace glissade::apps
