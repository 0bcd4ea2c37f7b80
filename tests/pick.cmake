speculum_test(handle_tests SOURCES edit_handles.cpp LIBRARIES edit ext::rapidcheck)
speculum_test(pick_tests SOURCES edit_pick.cpp picture_support.cpp LIBRARIES app LABELS pictures TIMEOUT 300)
speculum_test(demo_edit_tests SOURCES demo_edit.cpp demo_edit_saving.cpp demo_edit_models.cpp demo_inspector.cpp demo_edit_several.cpp picture_support.cpp virtual_display.cpp LIBRARIES app LABELS window
              TIMEOUT 300)
