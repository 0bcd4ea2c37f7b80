#pragma once

namespace speculum::testing_support {

// Factor for bounds of time and memory: sanitizers slow the program down and keep memory that was freed.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr int instrumented = 10;
#else
inline constexpr int instrumented = 1;
#endif

}  // namespace speculum::testing_support
