speculum_test(test_accuracy
  SOURCES accuracy_metrics.cpp accuracy_flip.cpp accuracy_pictures.cpp accuracy_report.cpp
          accuracy_plots.cpp html_check.cpp
  LIBRARIES accuracy ext::tbb)
speculum_test(sweep_tests SOURCES accuracy_sweep.cpp LIBRARIES accuracy)
