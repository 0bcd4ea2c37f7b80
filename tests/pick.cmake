speculum_test(handle_tests SOURCES edit_handles.cpp LIBRARIES edit ext::rapidcheck)
speculum_test(pick_tests SOURCES edit_pick.cpp LIBRARIES picture_support LABELS pictures)
