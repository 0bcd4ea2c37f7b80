speculum_test(ui_tests SOURCES ui_units.cpp ui_input_queue.cpp ui_panel_layout.cpp LIBRARIES ui)
