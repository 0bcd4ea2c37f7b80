# The layer that fault_layer/fault_layer.cpp describes, with a manifest for VK_ADD_LAYER_PATH, and one for XDG_DATA_HOME,
# which alone gets what is called before there is an instance.
add_library(fault_layer MODULE fault_layer/fault_layer.cpp)
target_link_libraries(fault_layer PRIVATE ext::vulkan speculum_flags)
set_target_properties(fault_layer PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests/fault_layer)
set(LIBRARY ${PROJECT_BINARY_DIR}/tests/fault_layer/libfault_layer.so)
set(IMPLICIT)
configure_file(fault_layer/manifest.json.in ${PROJECT_BINARY_DIR}/tests/fault_layer/fault_layer.json @ONLY)
set(IMPLICIT ",
    \"disable_environment\": { \"SPECULUM_NO_FAULT\": \"1\" },
    \"pre_instance_functions\": {
      \"vkEnumerateInstanceExtensionProperties\": \"faultInstanceExtensions\",
      \"vkEnumerateInstanceLayerProperties\": \"faultInstanceLayers\",
      \"vkEnumerateInstanceVersion\": \"faultInstanceVersion\"
    }")
configure_file(fault_layer/manifest.json.in
               ${PROJECT_BINARY_DIR}/tests/fault_layer/data/vulkan/implicit_layer.d/fault_layer.json @ONLY)
speculum_test(fault_tests SOURCES fault_matrix.cpp fault_devices.cpp LIBRARIES picture_support display_support LABELS window)
add_dependencies(fault_tests speculum fault_layer)
