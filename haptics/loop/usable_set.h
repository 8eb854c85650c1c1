#pragma once

/// Whether the haptic thread can work with a contact set.

#include <span>

#include <glissade/haptics/contact_set.h>

namespace glissade::haptics {

/// Whether every number is finite, and so small that no product of two of them overflows. No scene and no hand comes
/// near the bound. Real-time safe.
bool is_usable(std::span<const PartAnswer> parts, std::span<const ContactRow> rows,
               std::span<const HandAnswer> hands) noexcept;

}  // namespace glissade::haptics
