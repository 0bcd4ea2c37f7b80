# Flags shared by every target of this project.
add_library(speculum_flags INTERFACE)
if(MSVC)
  target_compile_options(speculum_flags INTERFACE /W3 /utf-8 /bigobj /EHsc /Zc:__cplusplus)
  target_compile_definitions(speculum_flags INTERFACE _CRT_SECURE_NO_WARNINGS)
else()
  target_compile_options(speculum_flags INTERFACE -Wall -Wextra -Wno-missing-field-initializers)
endif()
# GCC 12 sees overlapping copies in plain string concatenation (GCC bug 105651).
target_compile_options(speculum_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
# Same expression, same bits on every CPU: no contraction into fused multiply-adds.
target_compile_options(speculum_flags INTERFACE $<IF:$<BOOL:${MSVC}>,/fp:precise,-ffp-contract=off>)
if(WIN32)
  # Precompiled headers begin with this one; what has none begins with it too.
  set(names ${PROJECT_SOURCE_DIR}/external/windows_names.hpp)
  set(precompiled $<TARGET_PROPERTY:PRECOMPILE_HEADERS>$<TARGET_PROPERTY:PRECOMPILE_HEADERS_REUSE_FROM>)
  target_compile_options(speculum_flags INTERFACE
    "$<$<OR:$<BOOL:${CMAKE_DISABLE_PRECOMPILE_HEADERS}>,$<STREQUAL:${precompiled},>>:SHELL:$<IF:$<BOOL:${MSVC}>,/FI,-include> ${names}>")
endif()
# GCC's garbage collector takes a sixth of the time of large sources of tests, unless it begins at 2 GB.
if(SPECULUM_BUILD_TESTS)
  target_compile_options(speculum_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=2000000>)
endif()
if(SPECULUM_WARNINGS_AS_ERRORS)
  target_compile_options(speculum_flags INTERFACE -Werror)
endif()
if(SPECULUM_SANITIZE)
  target_compile_options(speculum_flags INTERFACE -fsanitize=${SPECULUM_SANITIZE} -fno-omit-frame-pointer
                                                  -fno-sanitize-recover=all)
  # Instrumented code confuses GCC's flow analysis, as its manual says.
  target_compile_options(speculum_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_link_options(speculum_flags INTERFACE -fsanitize=${SPECULUM_SANITIZE})
endif()

# speculum_precompiled(NAME LIBRARIES lib... HEADERS header... [LIGHT]): headers that many sources include, compiled once.
# Targets take them with use_precompiled(TARGET NAME), and need the same optimisation as NAME.
function(speculum_precompiled name)
  cmake_parse_arguments(ARG "LIGHT" "" "LIBRARIES;HEADERS" ${ARGN})
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp CONTENT "")
  add_library(${name} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} speculum_flags)
  target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
  if(ARG_LIGHT)
    target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
endfunction()

# GCC 12 takes string copies of a precompiled header for code of this project and warns of sizes that none has. Builds
# without precompiled headers, such as that of the sanitizers, keep these warnings.
function(use_precompiled target name)
  target_precompile_headers(${target} REUSE_FROM ${name})
  if(NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
    target_compile_options(${target} PRIVATE "$<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-stringop-overflow>")
  endif()
endfunction()

# Sources whose names end like this are the half of another system.
if(WIN32)
  set(foreign_system posix)
else()
  set(foreign_system win32)
endif()

# speculum_library(NAME PUBLIC dep... PRIVATE dep... [LIGHT]): the static library of src/NAME. Its headers are included as
# "NAME/header.hpp", and only by targets that link NAME: the include path holds nothing but that one folder. A LIGHT one
# waits for the user or the GPU: optimising it takes longer than it saves.
function(speculum_library name)
  cmake_parse_arguments(ARG "LIGHT" "" "PUBLIC;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "_${foreign_system}\\.cpp$")
  set(include_dir ${PROJECT_BINARY_DIR}/include/${name})
  file(MAKE_DIRECTORY ${include_dir})
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${include_dir}/${name} SYMBOLIC COPY_ON_ERROR)
  if(sources)
    add_library(${name} STATIC ${sources})
    target_include_directories(${name} PUBLIC ${include_dir})
    target_link_libraries(${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE} speculum_flags)
    if(ARG_LIGHT)
      target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
      use_precompiled(${name} light_headers)
    else()
      use_precompiled(${name} fast_headers)
    endif()
  else()
    add_library(${name} INTERFACE)
    target_include_directories(${name} INTERFACE ${include_dir})
    target_link_libraries(${name} INTERFACE ${ARG_PUBLIC})
  endif()
endfunction()

# speculum_page(TARGET FUNCTION name HEADER header PAGE html STYLES css... SCRIPTS js...): one page with its style sheets
# and scripts in it becomes a string of the target, which the function that the header declares returns.
function(speculum_page target)
  cmake_parse_arguments(ARG "" "FUNCTION;HEADER;PAGE" "STYLES;SCRIPTS" ${ARGN})
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${ARG_FUNCTION}.cpp)
  set(inline_page ${PROJECT_SOURCE_DIR}/src/accuracy/page/inline_page.cmake)
  list(JOIN ARG_STYLES "," styles)
  list(JOIN ARG_SCRIPTS "," scripts)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DPAGE=${ARG_PAGE} -DSTYLES=${styles} -DSCRIPTS=${scripts}
            -DHEADER=${ARG_HEADER} -DFUNCTION=${ARG_FUNCTION} -P ${inline_page}
    DEPENDS ${inline_page} ${ARG_PAGE} ${ARG_STYLES} ${ARG_SCRIPTS}
    COMMENT "Page ${ARG_FUNCTION}"
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()

find_program(GLSLANG_VALIDATOR glslangValidator)
find_program(SPIRV_VAL spirv-val)
if(NOT GLSLANG_VALIDATOR OR NOT SPIRV_VAL)
  message(FATAL_ERROR " glslangValidator or spirv-val is missing: install glslang-tools and spirv-tools (Debian, Ubuntu), "
                      "glslang and spirv-tools (Fedora, Arch) or glslang[tools] and spirv-tools[tools] (vcpkg)")
endif()

# speculum_shaders(TARGET OUTPUT dir SOURCES file... [ALL]): GLSL to dir/FILE.spv, each module checked by spirv-val.
function(speculum_shaders target)
  cmake_parse_arguments(ARG "ALL" "OUTPUT" "SOURCES" ${ARGN})
  file(MAKE_DIRECTORY ${ARG_OUTPUT})
  set(outputs)
  foreach(source IN LISTS ARG_SOURCES)
    get_filename_component(name ${source} NAME)
    get_filename_component(directory ${source} DIRECTORY)
    set(output ${ARG_OUTPUT}/${name}.spv)
    add_custom_command(
      OUTPUT ${output}
      COMMAND ${GLSLANG_VALIDATOR} --quiet -V --target-env vulkan1.1 -I${directory} --depfile ${output}.d -o ${output}
              ${source}
      COMMAND ${SPIRV_VAL} --target-env vulkan1.1 ${output}
      DEPENDS ${source}
      DEPFILE ${output}.d
      COMMENT "Shader ${name}"
      VERBATIM)
    list(APPEND outputs ${output})
  endforeach()
  if(ARG_ALL)
    add_custom_target(${target} ALL DEPENDS ${outputs})
  else()
    add_custom_target(${target} DEPENDS ${outputs})
  endif()
endfunction()
