add_test(NAME golden COMMAND speculum regress ${CMAKE_CURRENT_SOURCE_DIR}/golden/cases.toml --validation --jobs 1
                              --out ${PROJECT_BINARY_DIR}/tests/golden
                              --junit ${PROJECT_BINARY_DIR}/tests/results/golden.xml)
set_tests_properties(golden PROPERTIES COST 1001 LABELS pictures ENVIRONMENT "${SPECULUM_TEST_ENVIRONMENT}")
speculum_test(render_path_tests SOURCES render_paths.cpp LIBRARIES picture_support LABELS pictures)
speculum_test(finite_watch_tests SOURCES finite_watch.cpp LIBRARIES picture_support ext::spdlog LABELS pictures)
speculum_test(mirror_tests SOURCES mirror_pictures.cpp target_views.cpp
              LIBRARIES picture_support LABELS pictures)
speculum_test(skipping_tests SOURCES skipping_pictures.cpp LIBRARIES picture_support LABELS pictures)
speculum_test(command_line_tests SOURCES command_line.cpp completion.cpp LIBRARIES picture_support LABELS command_line)
add_dependencies(command_line_tests speculum)
speculum_test(truth_tests SOURCES truth_tests.cpp LIBRARIES picture_support LABELS pictures)
speculum_test(accuracy_command_tests SOURCES accuracy_command.cpp
              LIBRARIES picture_support LABELS command_line)
add_dependencies(accuracy_command_tests speculum)
speculum_test(effects_tests SOURCES effects_truth.cpp LIBRARIES picture_support LABELS pictures)
speculum_test(ray_tests SOURCES ray_methods.cpp scarce_memory.cpp LIBRARIES picture_support ext::spdlog LABELS pictures)
speculum_test(effects_ledger_tests SOURCES effects_ledger.cpp LIBRARIES picture_support LABELS pictures)
foreach(call CreateBuffer DestroyBuffer CreateImage DestroyImage CreateShaderModule DestroyShaderModule
             CreateDescriptorSetLayout DestroyDescriptorSetLayout CreateGraphicsPipelines CreateComputePipelines
             DestroyPipeline CmdDraw CmdDrawIndexed)
  target_link_options(effects_ledger_tests PRIVATE LINKER:--wrap=vk${call})
endforeach()
speculum_test(accumulated_tests SOURCES accumulated_pictures.cpp LIBRARIES picture_support LABELS pictures)
speculum_test(number_tests SOURCES number_ranges.cpp LIBRARIES picture_support LABELS pictures)
# The formatter of toml++ 3.3 converts -1 to size_t.
set_source_files_properties(number_ranges.cpp PROPERTIES COMPILE_OPTIONS -fno-sanitize=float-cast-overflow)
