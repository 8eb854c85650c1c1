#pragma once

/// Completion of commands, options and values in shells, made of what the parser knows about them.

#include <string>

namespace CLI {
class App;
}

namespace glissade::apps {

/// The script that completes the words of the program in bash. Where no word is known, bash completes names of files.
std::string bash_completion(const CLI::App& app);

/// The same for zsh, with descriptions.
std::string zsh_completion(const CLI::App& app);

}  // namespace glissade::apps
