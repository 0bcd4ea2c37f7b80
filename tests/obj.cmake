speculum_test(obj_tests SOURCES obj_text.cpp LIBRARIES scene)
