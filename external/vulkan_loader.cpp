#include "vulkan_loader.hpp"

#ifdef _WIN32
#include <windows.h>
#else
#include <dlfcn.h>
#endif

#include <stdexcept>
#include <string>

namespace speculum {

namespace {

struct Loader {
  void* library = nullptr;
  std::string error;  // why the library could not be opened
};

#ifdef _WIN32
Loader openLoader() {
  return {::LoadLibraryExW(L"vulkan-1.dll", nullptr, LOAD_LIBRARY_SEARCH_DEFAULT_DIRS), "vulkan-1.dll cannot be loaded"};
}

void* addressOf(void* library, const char* name) {
  return reinterpret_cast<void*>(::GetProcAddress(static_cast<HMODULE>(library), name));
}

constexpr const char* advice = "install the driver of the graphics card";
#else
Loader openLoader() {
  void* library = ::dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
  return {library, library ? "" : ::dlerror()};
}

void* addressOf(void* library, const char* name) {
  return ::dlsym(library, name);
}

constexpr const char* advice =
    "install libvulkan1 on Debian and Ubuntu, vulkan-loader on Fedora and openSUSE, vulkan-icd-loader on Arch";
#endif

}  // namespace

void* findVulkanFunction(const char* name) {
  static const Loader loader = openLoader();
  if (!loader.library) {
    throw std::runtime_error("Vulkan is missing: " + loader.error + " (" + advice + ")");
  }
  void* const address = addressOf(loader.library, name);
  if (!address) {
    throw std::runtime_error("the Vulkan loader has no " + std::string(name) + " (" + advice + ", or a newer version of it)");
  }
  return address;
}

}  // namespace speculum
