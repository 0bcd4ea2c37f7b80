speculum_test(scene_tests
  SOURCES scene_evaluate.cpp scene_loader.cpp scene_loader_errors.cpp scene_model.cpp scene_levels.cpp
          scene_limits.cpp
  LIBRARIES scene ext::spdlog ext::tomlplusplus)
