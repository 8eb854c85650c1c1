// The fuzz target as a plain program, for any compiler:
//   PROGRAM FILE...                  runs the target on files, such as those that `scripts/fuzz` has found
//   PROGRAM --mutations N [SEED]     runs it on its seeds and on N damaged ones
//   PROGRAM --write-seeds FOLDER     writes the seeds to FOLDER/seeds and the dictionary to FOLDER/dictionary
// A finding ends it by an uncaught exception, an abort or a sanitizer's report; the input stays in the file it names.

#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "fuzz_target.h"
#include "mutator.h"

namespace glissade::fuzz {
namespace {

void write(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file << bytes;
  if (!file.flush()) throw std::runtime_error("Cannot write " + path.string());
}

void write_seeds(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "seeds");
  for (const Seed& seed : seeds()) {
    write(folder / "seeds" / seed.name, seed.bytes);
  }
  std::string words;
  for (const std::string& word : dictionary()) {
    words += '"';
    for (const char c : word) {
      char code[5];
      std::snprintf(code, sizeof code, "\\x%02X", static_cast<unsigned>(static_cast<unsigned char>(c)));
      words += std::isalnum(static_cast<unsigned char>(c)) != 0 ? std::string(1, c) : std::string(code);
    }
    words += "\"\n";
  }
  write(folder / "dictionary", words);
}

void run_mutations(const std::string& program, int count, std::uint64_t random_seed) {
  const std::filesystem::path input = std::filesystem::path(program).filename().string() + ".input";
  std::cout << count << " mutations, seed " << random_seed << "; the one that fails stays in "
            << std::filesystem::absolute(input).string() << std::endl;
  const std::vector<Seed> originals = seeds();
  for (const Seed& seed : originals) {
    write(input, seed.bytes);
    if (!try_input(seed.bytes)) throw std::logic_error("The seed " + seed.name + " is refused");
  }
  Mutator mutator(random_seed, dictionary());
  int taken = 0;
  for (int i = 0; i < count; ++i) {
    const std::string& bytes = originals[mutator.below(originals.size())].bytes;
    std::string damaged = mutator.mutated(bytes, originals[mutator.below(originals.size())].bytes);
    if (mutator.below(8) != 0) repair(damaged);
    write(input, damaged);
    taken += try_input(damaged) ? 1 : 0;
  }
  std::filesystem::remove(input);
  std::cout << originals.size() << " seeds and " << taken << " damaged inputs taken, " << count - taken << " refused\n";
}

void replay(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error("Cannot read " + file);
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  std::cout << file << ": " << std::flush << (try_input(bytes) ? "taken" : "refused") << "\n";
}

}  // namespace
}  // namespace glissade::fuzz

int main(int argc, char** argv) {
  using namespace glissade::fuzz;
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.empty() || (arguments[0].starts_with("--") && arguments.size() < 2)) {
    std::cerr << "Usage: " << argv[0] << " FILE... | --mutations N [SEED] | --write-seeds FOLDER\n";
    return 2;
  }
  if (arguments[0] == "--write-seeds") {
    write_seeds(arguments[1]);
  } else if (arguments[0] == "--mutations") {
    run_mutations(argv[0], std::stoi(arguments[1]), arguments.size() > 2 ? std::stoull(arguments[2]) : 1);
  } else {
    for (const std::string& file : arguments) {
      replay(file);
    }
  }
}
