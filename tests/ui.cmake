speculum_test(ui_tests SOURCES ui_pass_tree.cpp ui_elide.cpp ui_frame_history.cpp ui_log_history.cpp
              ui_input_queue.cpp ui_panel_layout.cpp LIBRARIES ui)
