// Compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/front_kernels.cpp"
#include "kernels/front_kernels.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <glissade/base/assert.h>

HWY_BEFORE_NAMESPACE();
namespace glissade::collision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

std::size_t find_expired(std::span<const float> expiry, float clock, std::span<std::uint32_t> expired) {
  const hn::CappedTag<float, kFrontPadding> d;
  const hn::RebindToUnsigned<decltype(d)> d32;
  const std::size_t lanes = hn::Lanes(d);
  const auto limit = hn::Set(d, clock);
  std::size_t count = 0;
  for (std::size_t first = 0; first < expiry.size(); first += lanes) {
    const auto kept = hn::Gt(hn::LoadU(d, expiry.data() + first), limit);
    const auto chosen = hn::RebindMask(d32, hn::Not(kept));
    const auto place = hn::Iota(d32, static_cast<std::uint32_t>(first));
    // Stores a whole vector each time. Compresses in registers, because compressing to memory is slow.
    hn::StoreU(hn::Compress(place, chosen), d32, expired.data() + count);
    count += hn::CountTrue(d32, chosen);
  }
  return count;
}

}  // namespace glissade::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glissade::collision {
namespace {

HWY_EXPORT(find_expired);

}  // namespace

std::size_t find_expired(std::span<const float> expiry, float clock, std::span<std::uint32_t> expired) {
  GLISSADE_ASSERT(expiry.size() % kFrontPadding == 0 && expired.size() >= expiry.size());
  return HWY_DYNAMIC_DISPATCH(find_expired)(expiry, clock, expired);
}

}  // namespace glissade::collision
#endif
