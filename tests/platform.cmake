speculum_test(platform_tests SOURCES platform_files.cpp platform_folders.cpp platform_machine.cpp platform_process.cpp
              LIBRARIES platform ext::glm)
