#pragma once

#include <vulkan/vulkan.h>

// X(function, result...): functions that the program, Dear ImGui or GLFW calls, with the results other than VK_SUCCESS
// that the registry (vk.xml) lists for each. Left out: results that only extensions give which are not used.
#define SPECULUM_MEMORY VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY
#define SPECULUM_FAILING_FUNCTIONS(X)                                                                                  \
  X(vkAcquireNextImageKHR, SPECULUM_MEMORY, VK_ERROR_DEVICE_LOST, VK_ERROR_OUT_OF_DATE_KHR, VK_ERROR_SURFACE_LOST_KHR, \
    VK_TIMEOUT, VK_NOT_READY, VK_SUBOPTIMAL_KHR)                                                                       \
  X(vkAllocateCommandBuffers, SPECULUM_MEMORY)                                                                         \
  X(vkAllocateDescriptorSets, SPECULUM_MEMORY, VK_ERROR_FRAGMENTED_POOL, VK_ERROR_OUT_OF_POOL_MEMORY)                  \
  X(vkAllocateMemory, SPECULUM_MEMORY)                                                                                 \
  X(vkBeginCommandBuffer, SPECULUM_MEMORY)                                                                             \
  X(vkBindBufferMemory, SPECULUM_MEMORY)                                                                               \
  X(vkBindImageMemory, SPECULUM_MEMORY)                                                                                \
  X(vkCreateBuffer, SPECULUM_MEMORY)                                                                                   \
  X(vkCreateCommandPool, SPECULUM_MEMORY)                                                                              \
  X(vkCreateComputePipelines, SPECULUM_MEMORY)                                                                         \
  X(vkCreateDebugUtilsMessengerEXT, VK_ERROR_OUT_OF_HOST_MEMORY)                                                       \
  X(vkCreateDescriptorPool, SPECULUM_MEMORY)                                                                           \
  X(vkCreateDescriptorSetLayout, SPECULUM_MEMORY)                                                                      \
  X(vkCreateDevice, SPECULUM_MEMORY, VK_ERROR_INITIALIZATION_FAILED, VK_ERROR_EXTENSION_NOT_PRESENT,                   \
    VK_ERROR_FEATURE_NOT_PRESENT, VK_ERROR_TOO_MANY_OBJECTS, VK_ERROR_DEVICE_LOST)                                     \
  X(vkCreateFence, SPECULUM_MEMORY)                                                                                    \
  X(vkCreateFramebuffer, SPECULUM_MEMORY)                                                                              \
  X(vkCreateGraphicsPipelines, SPECULUM_MEMORY)                                                                        \
  X(vkCreateImage, SPECULUM_MEMORY)                                                                                    \
  X(vkCreateImageView, SPECULUM_MEMORY)                                                                                \
  X(vkCreateInstance, SPECULUM_MEMORY, VK_ERROR_INITIALIZATION_FAILED, VK_ERROR_LAYER_NOT_PRESENT,                     \
    VK_ERROR_EXTENSION_NOT_PRESENT, VK_ERROR_INCOMPATIBLE_DRIVER)                                                      \
  X(vkCreatePipelineCache, SPECULUM_MEMORY)                                                                            \
  X(vkCreatePipelineLayout, SPECULUM_MEMORY)                                                                           \
  X(vkCreateQueryPool, SPECULUM_MEMORY)                                                                                \
  X(vkCreateRenderPass, SPECULUM_MEMORY)                                                                               \
  X(vkCreateSampler, SPECULUM_MEMORY)                                                                                  \
  X(vkCreateSemaphore, SPECULUM_MEMORY)                                                                                \
  X(vkCreateShaderModule, SPECULUM_MEMORY)                                                                             \
  X(vkCreateSwapchainKHR, SPECULUM_MEMORY, VK_ERROR_DEVICE_LOST, VK_ERROR_SURFACE_LOST_KHR,                            \
    VK_ERROR_NATIVE_WINDOW_IN_USE_KHR, VK_ERROR_INITIALIZATION_FAILED)                                                 \
  X(vkCreateXcbSurfaceKHR, SPECULUM_MEMORY)                                                                            \
  X(vkCreateXlibSurfaceKHR, SPECULUM_MEMORY)                                                                           \
  X(vkDeviceWaitIdle, SPECULUM_MEMORY, VK_ERROR_DEVICE_LOST)                                                           \
  X(vkEndCommandBuffer, SPECULUM_MEMORY)                                                                               \
  X(vkEnumerateDeviceExtensionProperties, SPECULUM_MEMORY, VK_INCOMPLETE)                                              \
  X(vkEnumerateInstanceExtensionProperties, SPECULUM_MEMORY, VK_INCOMPLETE)                                            \
  X(vkEnumerateInstanceLayerProperties, SPECULUM_MEMORY, VK_INCOMPLETE)                                                \
  X(vkEnumerateInstanceVersion, VK_ERROR_OUT_OF_HOST_MEMORY)                                                           \
  X(vkEnumeratePhysicalDevices, SPECULUM_MEMORY, VK_ERROR_INITIALIZATION_FAILED, VK_INCOMPLETE)                        \
  X(vkFlushMappedMemoryRanges, SPECULUM_MEMORY)                                                                        \
  X(vkGetPhysicalDeviceImageFormatProperties, SPECULUM_MEMORY, VK_ERROR_FORMAT_NOT_SUPPORTED)                          \
  X(vkGetPhysicalDeviceSurfaceCapabilitiesKHR, SPECULUM_MEMORY, VK_ERROR_SURFACE_LOST_KHR)                             \
  X(vkGetPhysicalDeviceSurfaceFormatsKHR, SPECULUM_MEMORY, VK_ERROR_SURFACE_LOST_KHR, VK_INCOMPLETE)                   \
  X(vkGetPhysicalDeviceSurfacePresentModesKHR, SPECULUM_MEMORY, VK_ERROR_SURFACE_LOST_KHR, VK_INCOMPLETE)              \
  X(vkGetPhysicalDeviceSurfaceSupportKHR, SPECULUM_MEMORY, VK_ERROR_SURFACE_LOST_KHR)                                  \
  X(vkGetPipelineCacheData, SPECULUM_MEMORY, VK_INCOMPLETE)                                                            \
  X(vkGetQueryPoolResults, SPECULUM_MEMORY, VK_ERROR_DEVICE_LOST, VK_NOT_READY)                                        \
  X(vkGetSwapchainImagesKHR, SPECULUM_MEMORY, VK_INCOMPLETE)                                                           \
  X(vkMapMemory, SPECULUM_MEMORY, VK_ERROR_MEMORY_MAP_FAILED)                                                          \
  X(vkQueuePresentKHR, SPECULUM_MEMORY, VK_ERROR_DEVICE_LOST, VK_ERROR_OUT_OF_DATE_KHR, VK_ERROR_SURFACE_LOST_KHR,     \
    VK_SUBOPTIMAL_KHR)                                                                                                 \
  X(vkQueueSubmit, SPECULUM_MEMORY, VK_ERROR_DEVICE_LOST)                                                              \
  X(vkQueueWaitIdle, SPECULUM_MEMORY, VK_ERROR_DEVICE_LOST)                                                            \
  X(vkResetCommandPool, VK_ERROR_OUT_OF_DEVICE_MEMORY)                                                                 \
  X(vkResetFences, VK_ERROR_OUT_OF_DEVICE_MEMORY)                                                                      \
  X(vkSetDebugUtilsObjectNameEXT, SPECULUM_MEMORY)                                                                     \
  X(vkWaitForFences, SPECULUM_MEMORY, VK_ERROR_DEVICE_LOST, VK_TIMEOUT)
