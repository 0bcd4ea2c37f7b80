speculum_test(image_tests SOURCES image_color.cpp image_enlarge.cpp image_files.cpp image_exr_layout.cpp image_jpeg.cpp LIBRARIES image platform ext::tinyexr)
