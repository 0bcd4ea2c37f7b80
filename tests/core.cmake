# Shaders of these tests, built as those of the program are.
file(GLOB test_shader_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/shaders/*.vert
     ${CMAKE_CURRENT_LIST_DIR}/shaders/*.frag ${CMAKE_CURRENT_LIST_DIR}/shaders/*.comp)
speculum_shaders(test_shaders OUTPUT ${PROJECT_BINARY_DIR}/tests/core_shaders SOURCES ${test_shader_sources})

foreach(name core_retire_queue core_device core_render core_barriers core_pipeline)
  speculum_test(${name} SOURCES core_fixture.cpp ${name}.cpp LIBRARIES core ext::spdlog)
  add_dependencies(${name} test_shaders)
endforeach()
speculum_test(core_window SOURCES core_fixture.cpp core_window.cpp
              LIBRARIES core display_support ext::spdlog LABELS window)
add_dependencies(core_window test_shaders)
