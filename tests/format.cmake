add_test(NAME format COMMAND ${PROJECT_SOURCE_DIR}/scripts/format --check)
set_tests_properties(format PROPERTIES LABELS format)
add_test(NAME docs_links COMMAND ${PROJECT_SOURCE_DIR}/scripts/check-docs)
set_tests_properties(docs_links PROPERTIES LABELS format)
