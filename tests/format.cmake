add_test(NAME format COMMAND ${PROJECT_SOURCE_DIR}/scripts/format --check)
set_tests_properties(format PROPERTIES LABELS format)
