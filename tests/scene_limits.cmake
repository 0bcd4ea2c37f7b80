speculum_test(scene_limits SOURCES scene_limits.cpp LIBRARIES scene ext::spdlog TIMEOUT 30)
