speculum_test(ui_tests SOURCES ui_pass_tree.cpp LIBRARIES ui)
