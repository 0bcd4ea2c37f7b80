#pragma once

#include <cstddef>
#include <stdexcept>
#include <string_view>

namespace speculum::fuzz {

// What the fuzzers and the regression test do with an input: read it as a file that a user names, and use what was
// accepted. InputError with one line is the only way to refuse one; a longer message and anything accepted that breaks
// an invariant throw BrokenPromise, and other exceptions pass through.
class BrokenPromise : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

inline constexpr size_t kLargestInput = 64u << 10;  // bytes; more is not looked at

// A scene file. Beside it are t.obj, a triangle, and large.obj, whose vertices are at 1e200. Accepted scenes are
// evaluated and planned at several times.
void checkScene(std::string_view text);

// An OBJ file, behind a line `%mtl` its m.mtl. Beside them is t.png.
void checkModel(std::string_view text);

// A sweep's results.json and a sweep file: every input is tried as both.
void checkSweep(std::string_view text);

}  // namespace speculum::fuzz
