#pragma once

/// Standard input, output and error of a program.

namespace glissade::apps {

/// Gives a program that was started without them its three streams, so that no file that it opens takes their place:
/// empty input, output that cannot be written and so is reported as a failure, and errors that nobody reads. To be
/// called before any file is opened.
void complete_standard_streams();

}  // namespace glissade::apps
