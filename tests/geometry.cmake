speculum_test(geometry_tests SOURCES geometry_polygon.cpp geometry_projection.cpp geometry_depth.cpp
              geometry_faces.cpp geometry_convex_mesh.cpp geometry_triangulate.cpp
              LIBRARIES geometry ext::rapidcheck)
