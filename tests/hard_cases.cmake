set(hard ${CMAKE_CURRENT_LIST_DIR}/hard_cases)

speculum_test(hard_cases_transforms SOURCES ${hard}/transforms.cpp ${hard}/planes.cpp ${hard}/time_steps.cpp ${hard}/half_floats.cpp
              ${hard}/transform_support.cpp
              LIBRARIES systems LABELS hard_cases)
speculum_test(hard_cases_depth SOURCES ${hard}/depth_pictures.cpp LIBRARIES picture_support LABELS hard_cases pictures)
speculum_test(hard_cases_readout SOURCES ${hard}/depth_readout_pictures.cpp
              LIBRARIES picture_support LABELS hard_cases pictures)
speculum_test(hard_cases_scenes SOURCES ${hard}/scene_pictures.cpp ${hard}/seam_pictures.cpp ${hard}/bound_pictures.cpp
              LIBRARIES picture_support LABELS hard_cases pictures)
speculum_test(hard_cases_inputs SOURCES ${hard}/inputs.cpp LIBRARIES picture_support ext::spdlog LABELS hard_cases)
speculum_test(hard_cases_finite SOURCES ${hard}/finite_pictures.cpp
              LIBRARIES picture_support display_support LABELS hard_cases pictures window)
speculum_test(hard_cases_properties SOURCES ${hard}/properties.cpp ${hard}/transform_support.cpp
              LIBRARIES systems ext::rapidcheck LABELS hard_cases)
speculum_test(hard_cases_random SOURCES ${hard}/random_scenes.cpp support/random_scene.cpp occluder_shapes.cpp
              LIBRARIES picture_support LABELS hard_cases pictures)

# The patches that scripts/check-hard-cases tries must keep up with the sources.
add_test(NAME hard_case_mutations_apply COMMAND ${PROJECT_SOURCE_DIR}/scripts/check-hard-cases --applies)
set_tests_properties(hard_case_mutations_apply PROPERTIES LABELS hard_cases)

# Joins the pictures that scripts/hard-case-pictures draws.
add_executable(picture_strip ${hard}/picture_strip.cpp)
target_link_libraries(picture_strip PRIVATE image platform speculum_flags)
set_target_properties(picture_strip PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
