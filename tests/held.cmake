speculum_test(held_tests SOURCES held_pictures.cpp picture_support.cpp LIBRARIES app LABELS pictures TIMEOUT 300)
speculum_test(unchanged_tests SOURCES unchanged_pictures.cpp picture_support.cpp LIBRARIES app LABELS pictures
              TIMEOUT 300)
speculum_test(level_tests SOURCES level_pictures.cpp picture_support.cpp LIBRARIES app LABELS pictures TIMEOUT 300)
speculum_test(environment_tests SOURCES environment_pictures.cpp truth_support.cpp picture_support.cpp LIBRARIES app
              LABELS pictures TIMEOUT 300)
