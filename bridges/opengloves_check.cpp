#include <algorithm>
#include <optional>

#include <glissade/bridges/opengloves_check.h>
#include <glissade/bridges/serial_stream.h>
#include <glissade/realtime/clock.h>

#include "opengloves/line_codec.h"

namespace glissade::bridges {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr milliseconds kForFirstState{3000};
constexpr milliseconds kForRate{1500};

/// What has been heard.
struct Heard {
  GloveDecoder decoder;
  std::optional<GloveLine> first;
  nanoseconds first_time{0};
  nanoseconds last_time{0};
  FingerNumbers least{};
  FingerNumbers most{};

  void note(const GloveLine& line, nanoseconds now) {
    if (!first) {
      first = line;
      first_time = now;
      least = most = line.flexion;
    }
    last_time = now;
    for (std::size_t f = 0; f < kFingers; ++f) {
      least[f] = std::min(least[f], line.flexion[f]);
      most[f] = std::max(most[f], line.flexion[f]);
    }
  }
};

/// Answers each state, because the firmware may wait for that, with limits that leave the fingers free.
Heard hear_glove(SerialStream& stream, const std::function<bool()>& goes_on) {
  realtime::SteadyClock clock;
  Heard heard;
  const nanoseconds start = clock.now();
  stream.write("\n");  // the firmware ignores it, but no longer waits for a line
  for (nanoseconds now = start; goes_on(); now = clock.now()) {
    if (heard.first ? now - heard.first_time > kForRate : now - start > kForFirstState) break;
    const std::optional<GloveLine> line = heard.decoder.take(stream.read(milliseconds(20)));
    if (!line) continue;
    heard.note(*line, clock.now());
    stream.write(limit_line(line->encoding, FingerNumbers{}));
  }
  return heard;
}

std::string numbers_text(const FingerNumbers& numbers) {
  std::string text;
  for (const int number : numbers)
    text += (text.empty() ? "" : " ") + std::to_string(number);
  return text;
}

/// The start of a line that may have any bytes.
std::string printable(std::string_view line) {
  constexpr std::size_t kLongest = 60;
  std::string text(line.substr(0, kLongest));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return "'" + text + (line.size() > kLongest ? "...'" : "'");
}

bool tell_silence(const GloveDecoder& decoder, const std::function<void(const std::string&)>& say) {
  if (decoder.bytes() == 0) {
    say("nothing arrives; is the glove on, is this its port, and has its firmware this way of communication?");
    return false;
  }
  say(std::to_string(decoder.bytes()) + " bytes arrive, but no state of an OpenGloves glove; other firmware, or not " +
      std::to_string(kOpenGlovesBaudRate) + " baud?");
  if (decoder.refused() > 0) say("the last line that was no state: " + printable(decoder.last_refused()));
  return false;
}

void tell_scale(const Heard& heard, const OpenGlovesOptions& options,
                const std::function<void(const std::string&)>& say) {
  constexpr int kAvrMiddle_low = 400;
  constexpr int kAvrMiddle_high = 620;
  const int joystick = heard.first->joystick.value_or(0);
  const bool is_avr = kAvrMiddle_low < joystick && joystick < kAvrMiddle_high;
  if (is_avr && options.sensors[0].closed > 1023.0)
    say("the joystick rests at " + std::to_string(joystick) +
        ", so the board seems to count to 1023: use --full-scale 1023");
  if (heard.least == heard.most)
    say("no number has changed; open and close all fingers once, which also calibrates the firmware");
}

}  // namespace

bool check_opengloves(const OpenGlovesOptions& options, const std::function<bool()>& goes_on,
                      const std::function<void(const std::string&)>& say) {
  SerialStream stream(options.port, kOpenGlovesBaudRate, kOpenGlovesTcpPort);
  try {
    stream.open();
    say(options.port + ": the port is open");
    const Heard heard = hear_glove(stream, goes_on);
    if (!heard.first) return tell_silence(heard.decoder, say);
    const bool is_alpha = heard.first->encoding == OpenGlovesEncoding::kAlpha;
    say(std::string("states arrive in the encoding '") + (is_alpha ? "alpha'" : "legacy'"));
    say("the first numbers, thumb to little finger: " + numbers_text(heard.first->flexion));
    say("their ranges so far: " + numbers_text(heard.least) + " to " + numbers_text(heard.most));
    const double time_s = std::chrono::duration<double>(heard.last_time - heard.first_time).count();
    const double rate_Hz = time_s > 0.0 ? static_cast<double>(heard.decoder.states() - 1) / time_s : 0.0;
    say(std::to_string(static_cast<int>(rate_Hz)) + " states/s, " + std::to_string(heard.decoder.refused()) +
        " lines that were none");
    constexpr double kSlow_Hz = 30.0;
    if (rate_Hz < kSlow_Hz) say("that is slow: below 30 states/s, the fingers feel objects late");
    tell_scale(heard, options, say);
    return true;
  } catch (const WireError& error) {
    say(error.what());
    return false;
  }
}

}  // namespace glissade::bridges
