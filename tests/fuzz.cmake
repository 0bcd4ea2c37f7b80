add_subdirectory(${CMAKE_CURRENT_LIST_DIR}/fuzz)
speculum_test(fuzz_regressions SOURCES fuzz/fuzz_regressions.cpp fuzz/heap_watch.cpp LIBRARIES fuzz_checks)
