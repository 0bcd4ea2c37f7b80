# Writes OUTPUT, a C++ file that defines the Vulkan functions which the loader exports, from the header HEADER. Each looks
# its address up when it is first called, so a program that links them starts on a machine without Vulkan.
#   cmake -DHEADER=.../vulkan_core.h -DOUTPUT=FILE -P vulkan_functions.cmake
file(READ ${HEADER} header)
# A semicolon separates the items of CMake's lists, and a bracket keeps it from doing so.
string(REPLACE ";" "@" header "${header}")
string(REPLACE "[" "{" header "${header}")
string(REPLACE "]" "}" header "${header}")
string(REGEX MATCHALL "VKAPI_ATTR [A-Za-z0-9_]+ +VKAPI_CALL vk[A-Za-z0-9]+\\([^@]*\\)@" prototypes "${header}")

set(text "// Made by external/vulkan_functions.cmake.\n#include <vulkan/vulkan_core.h>\n\n#include \"vulkan_loader.hpp\"\n\n")
foreach(prototype IN LISTS prototypes)
  string(REGEX MATCH "VKAPI_ATTR ([A-Za-z0-9_]+) +VKAPI_CALL (vk[A-Za-z0-9]+)\\(([^@]*)\\)@" matched "${prototype}")
  set(type ${CMAKE_MATCH_1})
  set(name ${CMAKE_MATCH_2})
  set(parameters "${CMAKE_MATCH_3}")
  # Of extensions, the loader exports those of surfaces and swapchains.
  if(name MATCHES "[A-Z][A-Z]$" AND NOT name MATCHES "(Surface[A-Za-z]*|Swapchain[A-Za-z]*|AcquireNextImage|QueuePresent)KHR$")
    continue()
  endif()
  set(arguments "")
  if(NOT parameters STREQUAL "void")
    string(REPLACE "," ";" declarations "${parameters}")
    foreach(declaration IN LISTS declarations)
      string(REGEX MATCH "([A-Za-z0-9]+)({[0-9]+})?$" matched "${declaration}")
      list(APPEND arguments ${CMAKE_MATCH_1})
    endforeach()
    list(JOIN arguments ", " arguments)
  endif()
  string(APPEND text "extern \"C\" VKAPI_ATTR ${type} VKAPI_CALL ${name}(${parameters}) {\n"
                     "  static const auto function = speculum::vulkanFunction<PFN_${name}>(\"${name}\");\n"
                     "  return function(${arguments});\n}\n")
endforeach()
string(REGEX REPLACE "{([0-9]+)}" "[\\1]" text "${text}")
file(WRITE ${OUTPUT} "${text}")
