#pragma once

/// Marks a declaration of a public header that users of the shared library call. The library hides everything else. A
/// class is marked only if one of its members is not inline.
#define GLISSADE_EXPORT [[gnu::visibility("default")]]
