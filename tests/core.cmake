# Shaders of these tests, built as those of the program are.
file(GLOB test_shader_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/shaders/*.vert
     ${CMAKE_CURRENT_LIST_DIR}/shaders/*.frag ${CMAKE_CURRENT_LIST_DIR}/shaders/*.comp)
speculum_shaders(test_shaders OUTPUT ${PROJECT_BINARY_DIR}/tests/core_shaders SOURCES ${test_shader_sources})

speculum_test(core_tests SOURCES core_fixture.cpp core_retire_queue.cpp core_device.cpp core_render.cpp core_barriers.cpp
              core_pipeline.cpp
              LIBRARIES core ext::spdlog)
add_dependencies(core_tests test_shaders)
speculum_test(core_window SOURCES core_fixture.cpp core_window.cpp
              LIBRARIES core display_support ext::spdlog LABELS window)
add_dependencies(core_window test_shaders fault_layer)
