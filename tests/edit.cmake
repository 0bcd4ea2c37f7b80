speculum_test(edit_tests SOURCES edit_document.cpp edit_writer.cpp edit_text.cpp edit_random.cpp edit_save_place.cpp
              edit_support.cpp docs_tables.cpp
              LIBRARIES edit ext::rapidcheck)
