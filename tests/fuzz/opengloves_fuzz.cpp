// Bytes of a serial port at the decoder of OpenGloves gloves. Whatever arrives, in whatever pieces, the numbers stay
// within their range, and the pieces make no difference.

#include <cstdint>
#include <stdexcept>
#include <string>

#include "fuzz_target.h"
#include "opengloves/curl_limits.h"
#include "opengloves/line_codec.h"

namespace glissade::fuzz {
namespace {

using namespace bridges;

void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

void check(const GloveLine& line) {
  constexpr int kMostNumbers = 256;
  require(line.numbers >= 5 && line.numbers <= kMostNumbers, "the count of numbers is wrong");
  FingerValues curls{};
  for (std::size_t f = 0; f < kFingers; ++f) {
    require(line.flexion[f] >= 0 && line.flexion[f] <= kLargestNumber, "a number beyond its range");
    curls[f] = curl_of(line.flexion[f], {});
    require(curls[f] >= 0.0 && curls[f] <= 1.0, "a curl beyond its range");
  }
  for (const int limit : limit_numbers({}, curls))
    require(limit >= 0 && limit <= kLargestLimit, "a limit beyond its range");
  // What was read can be written and read again.
  std::string text = state_line(line.encoding, line.flexion, kLargestNumber);
  text.pop_back();
  const std::optional<GloveLine> again = decode_line(text);
  require(again && again->flexion == line.flexion && again->encoding == line.encoding, "a line that reads otherwise");
}

/// What a firmware makes of the same bytes.
void check_limits(std::string_view bytes) {
  LineCutter lines;
  lines.take(bytes, [](std::string_view line) {
    for (const auto encoding : {OpenGlovesEncoding::kAlpha, OpenGlovesEncoding::kLegacy})
      decode_limits(encoding, line);
  });
}

}  // namespace

bool try_input(std::string_view bytes) {
  GloveDecoder at_once;
  const std::optional<GloveLine> last = at_once.take(bytes);
  if (last) check(*last);
  GloveDecoder in_pieces;
  std::optional<GloveLine> newest;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const std::optional<GloveLine> line = in_pieces.take(bytes.substr(i, 1));
    if (line) check(*line);
    if (line) newest = line;
  }
  require(newest.has_value() == last.has_value(), "pieces make a difference");
  require(!newest || newest->flexion == last->flexion, "pieces make other numbers");
  require(at_once.states() == in_pieces.states() && at_once.refused() == in_pieces.refused(),
          "pieces make other counts");
  check_limits(bytes);
  return at_once.states() > 0 && at_once.refused() == 0;
}

std::vector<Seed> seeds() {
  std::string alpha;
  std::string legacy;
  for (int i = 0; i < 4; ++i) {
    const FingerNumbers flexion{i, 100 * i, 1000 * i, 4095, 0};
    alpha += state_line(OpenGlovesEncoding::kAlpha, flexion, 4095);
    legacy += state_line(OpenGlovesEncoding::kLegacy, flexion, 1023);
  }
  return {{"alpha", alpha},
          {"legacy", legacy},
          {"buttons", "A1B2C3D4E5F6G7P8HIJKLMNO(AB)9(BB)10(CB)11(DB)12(EB)13\n"},
          {"five", "A1B2C3D4E5\r\n"}};
}

std::vector<std::string> dictionary() {
  return {
      "A4095B4095C4095D4095E4095", "F2047G2047P0", "(AB)", "(AAA)", "HIJKLMNO", "\n", "\r\n", "&", "65535", "65536"};
}

/// Nothing is in the way of a mutation but a last line without its end.
void repair(std::string& bytes) {
  if (!bytes.ends_with('\n')) bytes += '\n';
}

}  // namespace glissade::fuzz
