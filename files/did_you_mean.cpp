#include <algorithm>
#include <cstddef>

#include <glissade/files/did_you_mean.h>
#include <glissade/files/text.h>

namespace glissade::files {
namespace {

/// The number of slips between two words.
std::size_t slips(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> now(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j)
    last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(now);
  }
  return last[b.size()];
}

}  // namespace

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
  constexpr std::size_t kLongest = 60;  // of a word that may be mistyped
  if (word.size() > kLongest) return "";
  const std::string* best = nullptr;
  std::size_t fewest = 0;
  for (const std::string& name : known) {
    // A name that was cut short, or a third of the word wrong.
    const bool is_begun = word.size() >= 3 && name.starts_with(word);
    const std::size_t count = is_begun ? 1 : slips(word, name);
    if (count > std::max<std::size_t>(1, std::min(word.size(), name.size()) / 3)) continue;
    if (best != nullptr && count >= fewest) continue;
    best = &name;
    fewest = count;
  }
  return best == nullptr ? "" : " (did you mean " + in_quotes(*best) + "?)";
}

}  // namespace glissade::files
