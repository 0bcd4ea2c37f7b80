speculum_test(test_accuracy
  SOURCES accuracy_metrics.cpp accuracy_flip.cpp accuracy_pictures.cpp
  LIBRARIES accuracy ext::tbb)
speculum_test(sweep_tests SOURCES accuracy_sweep.cpp LIBRARIES accuracy)
