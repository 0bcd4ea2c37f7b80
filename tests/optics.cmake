speculum_test(optics_tests SOURCES optics_polygon.cpp optics_reflection.cpp optics_projection.cpp optics_depth.cpp optics_faces.cpp optics_convex_mesh.cpp
              LIBRARIES optics ext::rapidcheck)
