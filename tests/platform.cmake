speculum_test(platform_tests SOURCES platform_files.cpp platform_system.cpp
              LIBRARIES platform ext::glm)
