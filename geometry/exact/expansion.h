#pragma once

/// Exact sums and products of doubles, kept as expansions (J. R. Shewchuk, "Adaptive precision floating-point
/// arithmetic and fast robust geometric predicates", 1997).
///
/// An expansion is a sum of nonzero doubles that do not overlap, in order of increasing magnitude. Its sign is that of
/// its last component. All results are exact as long as no product underflows or overflows. This requires rounding to
/// nearest and no value-changing compiler options (no -ffast-math, -ffp-contract=off).

#include <array>
#include <cmath>
#include <cstddef>

namespace glissade::geometry {

/// An exact value as the sum of at most `capacity` doubles.
template <std::size_t capacity>
class Expansion {
 public:
  Expansion() = default;

  std::size_t size() const { return size_; }
  double operator[](std::size_t i) const { return components_[i]; }

  /// Appends a component, which must be more significant than all before it. Zeros are left out.
  void push(double component) {
    if (component != 0.0) {
      components_[size_++] = component;
    }
  }

  int sign() const {
    if (size_ == 0) {
      return 0;
    }
    return components_[size_ - 1] > 0.0 ? 1 : -1;
  }

 private:
  std::array<double, capacity> components_;  // only the first size_ are ever read
  std::size_t size_ = 0;
};

/// A rounded result and its rounding error: `value + error` is exact.
struct Rounded {
  double value;
  double error;
};

inline Rounded exact_sum(double a, double b) {
  const double value = a + b;
  const double b_seen = value - a;
  const double a_seen = value - b_seen;
  return {value, (a - a_seen) + (b - b_seen)};
}

inline Rounded exact_product(double a, double b) {
  const double value = a * b;
  return {value, std::fma(a, b, -value)};
}

/// The exact difference of two doubles.
inline Expansion<2> exact_difference(double a, double b) {
  const Rounded difference = exact_sum(a, -b);
  Expansion<2> result;
  result.push(difference.error);
  result.push(difference.value);
  return result;
}

/// e + sign · f, where sign is 1 or -1.
template <std::size_t n, std::size_t m>
Expansion<n + m> combine(const Expansion<n>& e, const Expansion<m>& f, double sign) {
  Expansion<n + m> result;
  std::size_t i = 0;
  std::size_t j = 0;
  double carry = 0.0;
  while (i < e.size() || j < f.size()) {
    // The components of both are taken in order of increasing magnitude.
    const bool from_e = j == f.size() || (i < e.size() && std::abs(e[i]) < std::abs(f[j]));
    const Rounded sum = exact_sum(carry, from_e ? e[i++] : sign * f[j++]);
    result.push(sum.error);
    carry = sum.value;
  }
  result.push(carry);
  return result;
}

template <std::size_t n, std::size_t m>
Expansion<n + m> operator+(const Expansion<n>& e, const Expansion<m>& f) {
  return combine(e, f, 1.0);
}

template <std::size_t n, std::size_t m>
Expansion<n + m> operator-(const Expansion<n>& e, const Expansion<m>& f) {
  return combine(e, f, -1.0);
}

template <std::size_t n>
Expansion<2 * n> operator*(const Expansion<n>& e, double factor) {
  Expansion<2 * n> result;
  double carry = 0.0;
  for (std::size_t i = 0; i < e.size(); ++i) {
    const Rounded product = exact_product(e[i], factor);
    const Rounded low = exact_sum(carry, product.error);
    result.push(low.error);
    const Rounded high = exact_sum(product.value, low.value);
    result.push(high.error);
    carry = high.value;
  }
  result.push(carry);
  return result;
}

/// Product with an expansion of two components, such as a difference of two doubles.
template <std::size_t n>
Expansion<4 * n> operator*(const Expansion<n>& e, const Expansion<2>& f) {
  Expansion<4 * n> result;
  if (f.size() == 0) {
    return result;
  }
  const Expansion<2 * n> first = e * f[0];
  if (f.size() == 2) {
    return first + e * f[1];
  }
  for (std::size_t i = 0; i < first.size(); ++i) {
    result.push(first[i]);
  }
  return result;
}

}  // namespace glissade::geometry
