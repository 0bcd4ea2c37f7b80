# An archive: one folder that can be put anywhere.
if(SPECULUM_ARCHIVE)
  set(CMAKE_INSTALL_BINDIR .)
  set(CMAKE_INSTALL_DOCDIR .)
  set(SPECULUM_DATA_DIR .)
  set(examples examples/bin)
else()
  include(GNUInstallDirs)
  set(SPECULUM_DATA_DIR ${CMAKE_INSTALL_DATADIR}/speculum)
  set(examples ${CMAKE_INSTALL_LIBEXECDIR}/speculum/examples)
endif()
if(TARGET speculum)
  install(TARGETS speculum RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(DIRECTORY ${PROJECT_BINARY_DIR}/shaders/ DESTINATION ${SPECULUM_DATA_DIR}/shaders FILES_MATCHING PATTERN "*.spv"
        PATTERN CMakeFiles EXCLUDE)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/models/ DESTINATION ${SPECULUM_DATA_DIR}/models
        FILES_MATCHING PATTERN "*.obj" PATTERN "*.mtl" PATTERN "*.png" PATTERN "*.jpg")
install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenes/ DESTINATION ${SPECULUM_DATA_DIR}/scenes
        FILES_MATCHING PATTERN "*.toml" PATTERN "*.jpg")
install(DIRECTORY ${PROJECT_SOURCE_DIR}/lessons/ DESTINATION ${SPECULUM_DATA_DIR}/lessons FILES_MATCHING PATTERN "*.toml")
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples/ DESTINATION ${SPECULUM_DATA_DIR}/examples)
# The examples' programs; what they need of their folders is among the data above.
install(TARGETS triangle offscreen one_mirror mirror_in_mirror RUNTIME DESTINATION ${examples})
install(DIRECTORY ${PROJECT_BINARY_DIR}/examples/shaders DESTINATION ${examples} FILES_MATCHING PATTERN "*.spv")
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
if(SPECULUM_ARCHIVE)
  return()
endif()
install(FILES ${PROJECT_SOURCE_DIR}/scripts/speculum-completion.bash
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME speculum)

# Desktop entry, icons, manual page. The program writes the page; one with a sanitizer may fail at that.
set(package ${PROJECT_SOURCE_DIR}/cmake/package)
set(written ${PROJECT_BINARY_DIR}/package)
install(FILES ${package}/speculum.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
install(FILES ${package}/speculum.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
string(TIMESTAMP today "%Y-%m-%d" UTC)
find_program(RSVG_CONVERT rsvg-convert)
if(TARGET speculum AND NOT SPECULUM_SANITIZE)
  file(MAKE_DIRECTORY ${written})
  add_custom_command(
    OUTPUT ${written}/speculum.1.gz
    COMMAND ${package}/man-page $<TARGET_FILE:speculum> ${today} ${written}/speculum.1
    COMMAND gzip -9nf ${written}/speculum.1
    DEPENDS speculum ${package}/man-page
    COMMENT "Manual page"
    VERBATIM)
  set(extras ${written}/speculum.1.gz)
  install(FILES ${written}/speculum.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  if(RSVG_CONVERT)
    add_custom_command(OUTPUT ${written}/speculum.png
                       COMMAND ${RSVG_CONVERT} -w 48 -h 48 -o ${written}/speculum.png ${package}/speculum.svg
                       DEPENDS ${package}/speculum.svg VERBATIM)
    list(APPEND extras ${written}/speculum.png)
    install(FILES ${written}/speculum.png DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/48x48/apps)
  endif()
  add_custom_target(package_extras ALL DEPENDS ${extras})
endif()

# cpack -G DEB. Shared libraries become dependencies by themselves, except the Vulkan loader, which is opened at run time.
set(CPACK_GENERATOR DEB)
# The domain is reserved by RFC 2606: the project has no address. Who repackages it gives their own with -D.
set(CPACK_PACKAGE_CONTACT "The Speculum authors <noreply@example.org>" CACHE STRING "Maintainer of the package")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "planar mirrors in Vulkan that can be trusted")
set(CPACK_PACKAGE_DESCRIPTION "Renders scenes with planar mirrors in real time and says how far each
setting is from a ray-traced reference. Compares pictures of scenes with
expected ones, without a display, as a regression test.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
                                                WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_PROJECT_CONFIG_FILE ${package}/cpack.cmake)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libvulkan1, mesa-vulkan-drivers | vulkan-icd, fonts-dejavu-core")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "fontconfig")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "glslang-tools, vulkan-validationlayers")
file(READ ${PROJECT_SOURCE_DIR}/LICENSE license)
string(REGEX REPLACE "^.*(Permission is hereby)" "\\1" license "${license}")
string(REGEX REPLACE "\n\n" "\n.\n" license "${license}")
string(REGEX REPLACE "\n$" "" license "${license}")
string(REPLACE "\n" "\n " EXPAT " ${license}")
configure_file(${package}/copyright.in ${written}/copyright @ONLY)
install(FILES ${written}/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR})
# Code of these libraries is in the program; the others are packages that it depends on.
foreach(library libimgui-dev libglm-dev nlohmann-json3-dev libcli11-dev)
  install(FILES /usr/share/doc/${library}/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR}/libraries
          RENAME ${library}.txt OPTIONAL)
endforeach()
find_program(GZIP gzip)
if(GZIP)
  file(WRITE ${written}/changelog "speculum (${PROJECT_VERSION}) stable; urgency=medium\n\n  * See docs/changelog.md of the sources.\n\n -- ${CPACK_PACKAGE_CONTACT}  Sun, 22 Nov 2026 00:00:00 +0000\n")
  execute_process(COMMAND ${GZIP} -9nf ${written}/changelog)
  install(FILES ${written}/changelog.gz DESTINATION ${CMAKE_INSTALL_DOCDIR})
endif()
include(CPack)
