speculum_test(scarce_memory_tests SOURCES journeys_memory.cpp scarce_memory.cpp
              LIBRARIES picture_support display_support LABELS window)
