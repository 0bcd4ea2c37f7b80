speculum_test(handle_tests SOURCES edit_handles.cpp LIBRARIES edit ext::rapidcheck)
speculum_test(pick_tests SOURCES edit_pick.cpp LIBRARIES picture_support LABELS pictures)
speculum_test(demo_edit_tests SOURCES demo_edit.cpp demo_edit_saving.cpp demo_edit_models.cpp demo_inspector.cpp
              demo_edit_several.cpp LIBRARIES picture_support display_support LABELS window)
