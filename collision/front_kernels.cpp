// Compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "glissade/collision/front_kernels.cpp"
#include "front_kernels.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace glissade::collision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void find_expired(std::span<const float> expiry, float clock, std::vector<std::uint32_t>& expired) {
  expired.clear();
  const hn::ScalableTag<float> d;
  const std::size_t lanes = hn::Lanes(d);
  const auto limit = hn::Set(d, clock);
  std::size_t first = 0;
  for (; first + lanes <= expiry.size(); first += lanes) {
    if (hn::AllTrue(d, hn::Gt(hn::LoadU(d, expiry.data() + first), limit))) continue;
    for (std::size_t i = first; i < first + lanes; ++i) {
      if (!(expiry[i] > clock)) expired.push_back(static_cast<std::uint32_t>(i));
    }
  }
  for (; first < expiry.size(); ++first) {
    if (!(expiry[first] > clock)) expired.push_back(static_cast<std::uint32_t>(first));
  }
}

}  // namespace glissade::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glissade::collision {
namespace {

HWY_EXPORT(find_expired);

}  // namespace

void find_expired(std::span<const float> expiry, float clock, std::vector<std::uint32_t>& expired) {
  HWY_DYNAMIC_DISPATCH(find_expired)(expiry, clock, expired);
}

}  // namespace glissade::collision
#endif
