# Controllers and panels of the window, without a display.
speculum_test(workspace_tests SOURCES workspace_editing.cpp workspace_saving.cpp workspace_view.cpp app_units.cpp app_motion.cpp
              LIBRARIES picture_support ext::spdlog)
speculum_test(panel_tests SOURCES ui_panels.cpp ui_input_map.cpp LIBRARIES picture_support ext::imgui)
speculum_test(thumbnail_tests SOURCES thumbnails.cpp picture_agreement.cpp LIBRARIES picture_support LABELS pictures)

# Journeys through the window, on a display of their own.
foreach(name journeys journeys_idle)
  speculum_test(${name} SOURCES ${name}.cpp LIBRARIES picture_support display_support ext::imgui LABELS window)
  add_dependencies(${name} speculum)
endforeach()
speculum_test(journeys_random SOURCES journeys_random.cpp LIBRARIES picture_support display_support LABELS window)

# scripts/pace
add_executable(pace_measure EXCLUDE_FROM_ALL pace_measure.cpp)
target_link_libraries(pace_measure PRIVATE app display_support speculum_flags)
add_dependencies(pace_measure shaders)
set_target_properties(pace_measure PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
