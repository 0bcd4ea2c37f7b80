# Shaders of these tests, built as those of the program are.
set(test_shader_dir ${PROJECT_BINARY_DIR}/tests/core_shaders)
file(MAKE_DIRECTORY ${test_shader_dir})
file(GLOB test_shader_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/shaders/*.vert
     ${CMAKE_CURRENT_LIST_DIR}/shaders/*.frag)
set(test_shader_outputs)
foreach(source IN LISTS test_shader_sources)
  get_filename_component(name ${source} NAME)
  set(output ${test_shader_dir}/${name}.spv)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${GLSLANG_VALIDATOR} --quiet -V --target-env vulkan1.1 -I${CMAKE_CURRENT_LIST_DIR}/shaders
            --depfile ${output}.d -o ${output} ${source}
    COMMAND ${SPIRV_VAL} --target-env vulkan1.1 ${output}
    DEPENDS ${source}
    DEPFILE ${output}.d
    COMMENT "Test shader ${name}"
    VERBATIM)
  list(APPEND test_shader_outputs ${output})
endforeach()
add_custom_target(test_shaders DEPENDS ${test_shader_outputs})

foreach(name core_platform core_device core_render core_barriers core_pipeline)
  speculum_test(${name} SOURCES core_fixture.cpp ${name}.cpp LIBRARIES core ext::spdlog)
  add_dependencies(${name} test_shaders)
endforeach()
speculum_test(core_window SOURCES core_fixture.cpp virtual_display.cpp core_window.cpp LIBRARIES core ext::spdlog
              LABELS window)
add_dependencies(core_window test_shaders)
