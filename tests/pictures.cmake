speculum_test(golden_tests SOURCES golden_tests.cpp picture_support.cpp LIBRARIES app LABELS pictures TIMEOUT 300)
speculum_test(mirror_tests SOURCES mirror_image.cpp mirror_pictures.cpp picture_support.cpp LIBRARIES app LABELS pictures
              TIMEOUT 300)
