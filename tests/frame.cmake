speculum_test(frame_tests
              SOURCES frame_settings.cpp frame_plan.cpp frame_pictures.cpp frame_cached_images.cpp frame_unchanged.cpp frame_environment.cpp frame_shadow_maps.cpp
                      frame_memory.cpp frame_depth.cpp frame_skipping.cpp frame_clusters.cpp frame_levels.cpp
                      frame_pass_range.cpp frame_picture_tiles.cpp frame_occlusion.cpp occluder_shapes.cpp reference_scenes.cpp frame_limits.cpp
              LIBRARIES frame ext::rapidcheck)
