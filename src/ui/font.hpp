#pragma once

#include <filesystem>

namespace speculum {

// A sans serif font of the system whose digits are equally wide; empty if there is none.
std::filesystem::path findFont();

}  // namespace speculum
