speculum_test(test_reference
  SOURCES geometry_bvh.cpp reference_mirrors.cpp reference_tracer.cpp reference_scenes.cpp
  LIBRARIES reference ext::tbb ext::embree)
