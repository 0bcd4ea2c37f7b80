speculum_test(obj_tests SOURCES obj_loader.cpp obj_materials.cpp LIBRARIES scene ext::spdlog ext::tinyobjloader)
