# Toolchain of scripts/windows: Debian's cross compiler, and the libraries that the script has built.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
set(CMAKE_FIND_ROOT_PATH ${CMAKE_CURRENT_LIST_DIR}/../build/windows/deps /usr/x86_64-w64-mingw32)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
# The host's pkg-config knows the host's libraries only.
set(CMAKE_DISABLE_FIND_PACKAGE_PkgConfig ON)
set(CMAKE_CROSSCOMPILING_EMULATOR ${CMAKE_CURRENT_LIST_DIR}/windows/run-wine)
# The program carries all that it needs. Without a time of linking in it, two builds give the same bytes. CRT_fp8.o: every
# thread computes with Windows' own precision of the x87, which the library's pow() and exp() use; MinGW would set
# another for its threads, but not for those of oneTBB, and a figure would depend on who computed it.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static -Wl,--no-insert-timestamp -Wl,-l:CRT_fp8.o")
set(ZLIB_USE_STATIC_LIBS ON)
# FindVulkan asks for an import library, which nothing links: the loader is opened at run time.
set(Vulkan_LIBRARY vulkan-1)
