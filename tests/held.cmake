speculum_test(held_tests SOURCES held_pictures.cpp picture_support.cpp LIBRARIES app LABELS pictures TIMEOUT 300)
