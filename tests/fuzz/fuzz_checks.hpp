#pragma once

#include <cstddef>
#include <stdexcept>
#include <string_view>

namespace speculum::fuzz {

// Checks of the fuzzers and of the regression test: each reads an input as a file that a user names, and uses it if it
// is accepted. An input may only be refused by an InputError of one line, a picture by a FileError of one line. A
// longer message and a broken invariant throw BrokenPromise; other exceptions pass through. The checks return whether
// the input was accepted.
class BrokenPromise : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

inline constexpr size_t largestInput = 64u << 10;  // bytes; larger inputs are ignored

// A scene file. Beside it are t.obj, a triangle, and large.obj, whose vertices are at 1e200. Accepted scenes are
// evaluated and planned at several times.
bool checkScene(std::string_view text);

// An OBJ file and, behind a line `%mtl`, its m.mtl. Beside these files is t.png.
bool checkModel(std::string_view text);

// A glTF file, as text or binary. Beside it are t.png and t.bin. Accepted models are opened as scenes.
bool checkGltf(std::string_view content);

// A PNG, JPEG or EXR file.
bool checkPicture(std::string_view bytes);

// A sweep's results.json, a sweep file, and the files of a sweep's cache: every input is tried as each of them. No
// cache is refused: what cannot be read counts as absent.
bool checkSweep(std::string_view text);

// A file of cases. Beside it are room.toml, hall.obj and mask.png. Accepted cases are matched with drivers and
// reported.
bool checkCase(std::string_view text);

// A layout of the panels, with sections that are not theirs. No layout is refused: values that no window can have are
// ignored, and panels stay reachable in displays of several sizes. Counts as accepted if it says anything about a
// panel.
bool checkLayout(std::string_view text);

// A copy of unsaved changes behind a line with the scene's name: it is kept, offered, read, kept again and forgotten.
// Beside the folder of copies' folders is t.obj, ../../t.obj from a copy.
bool checkRecovery(std::string_view input);

}  // namespace speculum::fuzz
