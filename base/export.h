#pragma once

/// Marks a declaration of a public header that users of the shared library call. All else is hidden in this library.
/// Classes are marked only if something of theirs is not inline.
#define GLISSADE_EXPORT [[gnu::visibility("default")]]
