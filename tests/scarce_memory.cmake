speculum_test(scarce_memory_tests
              SOURCES demo_memory.cpp scarce_memory.cpp picture_support.cpp virtual_display.cpp
              LIBRARIES app
              LABELS window TIMEOUT 300)
