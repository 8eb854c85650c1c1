#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <glissade/apps/report/plot_axis.h>

namespace glissade::apps {

namespace {

/// The smallest 1, 2 or 5 times a power of ten that divides `extent` into at most `most` steps.
double nice_step(double extent, int most) {
  const double raw = extent / most;
  const double magnitude = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * magnitude >= raw * (1.0 - 1e-9)) return factor * magnitude;
  }
  return 10.0 * magnitude;
}

std::string label_of(double value, double step, double largest) {
  std::array<char, 32> buffer{};
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  if (decimals > 6 || largest >= 1e7) {
    const auto exponent = [](double x) { return static_cast<int>(std::floor(std::log10(x) + 1e-9)); };
    const int digits = exponent(std::max(largest, step)) - exponent(step);
    std::snprintf(buffer.data(), buffer.size(), "%.*e", std::clamp(digits, 0, 16), value);
  } else {
    std::snprintf(buffer.data(), buffer.size(), "%.*f", decimals, value);
  }
  return buffer.data();
}

}  // namespace

AxisTicks axis_ticks(double low, double high, int most, double least_step) {
  AxisTicks ticks{std::max(nice_step(high - low, most), least_step), {}, {}};
  const double slack = 1e-9 * ticks.step;
  const double largest = std::max(std::abs(low), std::abs(high));
  const auto first = std::ceil((low - slack) / ticks.step);
  const auto count = static_cast<int>(std::floor((high + slack) / ticks.step) - first) + 1;
  for (int i = 0; i < count; ++i) {
    // Adding 0.0 turns a negative zero into a positive one.
    const double value = (first + i) * ticks.step + 0.0;
    ticks.values.push_back(value);
    ticks.labels.push_back(label_of(value, ticks.step, largest));
  }
  return ticks;
}

AxisRange rounded_range(double low, double high, int most, double least_step) {
  // A flat line is drawn in the middle. Variation below the resolution of the numbers is flat, and so is what is
  // nothing to a hand: a millionth of a newton, a millimetre or a degree.
  constexpr double kNothing = 1e-6;
  const double largest = std::max(std::abs(low), std::abs(high));
  if (high - low <= std::max(1e-9 * largest, kNothing)) {
    low = largest <= kNothing ? -1.0 : low - 0.5 * std::abs(low);
    high = largest <= kNothing ? 1.0 : high + 0.5 * std::abs(high);
  }
  const double step = std::max(nice_step(high - low, most), least_step);
  return {std::floor(low / step + 1e-9) * step, std::ceil(high / step - 1e-9) * step};
}

}  // namespace glissade::apps
