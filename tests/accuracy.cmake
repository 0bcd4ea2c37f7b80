speculum_test(test_accuracy
  SOURCES accuracy_metrics.cpp accuracy_flip.cpp accuracy_pictures.cpp accuracy_report.cpp report_example.cpp
  LIBRARIES accuracy ext::tbb)
speculum_test(sweep_tests SOURCES accuracy_sweep.cpp LIBRARIES accuracy)

# The reports in a headless browser. Debian's python3-selenium belongs to Debian's own Python.
add_executable(report_pages report_pages.cpp report_example.cpp)
target_link_libraries(report_pages PRIVATE regress speculum_flags)
set_target_properties(report_pages PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
add_test(NAME report_page COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/report_page.py $<TARGET_FILE:report_pages>)
set_tests_properties(report_page PROPERTIES COST 990 LABELS page TIMEOUT 300)
