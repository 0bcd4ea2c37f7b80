#pragma once

// Comes before all else on Windows, where libraries include its header: takes back the macros that are words of this
// project.
#ifndef NOMINMAX
#define NOMINMAX
#endif
#ifndef WIN32_LEAN_AND_MEAN
#define WIN32_LEAN_AND_MEAN
#endif
#include <windows.h>
#undef near
#undef far
// Headers of Windows that come later write them as these.
#undef NEAR
#undef FAR
#define NEAR
#define FAR
