# cmake --install: the libraries of this build, for its processor; their headers; the interfaces of hal; and of a build for
# this machine its programs with man pages and completions. A project then says find_package(firmtouch).
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
get_property(modules GLOBAL PROPERTY FIRMTOUCH_MODULES)
set(folder ${CMAKE_INSTALL_LIBDIR}/cmake/firmtouch)
set_target_properties(firmtouch_libc_objects PROPERTIES EXCLUDE_FROM_ALL OFF EXPORT_NAME libc_objects)
install(TARGETS ${modules} firmtouch_hal firmtouch_libc_objects EXPORT firmtouch-targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} OBJECTS DESTINATION ${CMAKE_INSTALL_LIBDIR}/firmtouch)
install(EXPORT firmtouch-targets NAMESPACE firmtouch:: DESTINATION ${folder})
install(DIRECTORY firmware/firmtouch hal/firmtouch DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN *.hpp)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/firmtouch-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES firmware/cmake/firmtouch-config.cmake tools/cmake/firmtouch_bake.cmake
              ${CMAKE_BINARY_DIR}/firmtouch-config-version.cmake DESTINATION ${folder})
# The bill of materials. Its name holds a hash of the sources.
file(GLOB_RECURSE files RELATIVE ${PROJECT_SOURCE_DIR} firmware/firmtouch/*.hpp firmware/firmtouch/*.cpp)
set(tree_hash "")
foreach(file ${files})
  file(SHA256 ${PROJECT_SOURCE_DIR}/${file} hash)
  string(SHA256 tree_hash "${tree_hash}${hash}${file}")
endforeach()
string(TIMESTAMP created "%Y-%m-%dT%H:%M:%SZ" UTC)  # SOURCE_DATE_EPOCH, where it is set
configure_file(firmware/cmake/sbom.spdx.json.in ${CMAKE_BINARY_DIR}/firmtouch.spdx.json @ONLY)
install(FILES LICENSE CHANGELOG.md ${CMAKE_BINARY_DIR}/firmtouch.spdx.json DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/firmtouch)
if(FIRMTOUCH_TOOLS)
  install(TARGETS firmtouch firmtouch-sim RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  # Man pages and shell completions, from what --help prints.
  install(CODE "execute_process(COMMAND sh \"${PROJECT_SOURCE_DIR}/tools/cli/help_pages.sh\" \"$<TARGET_FILE_DIR:firmtouch>\"
                                        \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}\" RESULT_VARIABLE failed)
                if(failed)
                  message(FATAL_ERROR \"tools/cli/help_pages.sh fails\")
                endif()")
endif()
# cpack -G DEB: a Debian package of the same.
if(FIRMTOUCH_TOOLS)
  set(CPACK_PACKAGE_CONTACT "The Firmtouch authors")
  set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Baker, simulator and libraries for touch rendering in fixed memory")
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
  set(CPACK_VERBATIM_VARIABLES ON)
  include(CPack)
endif()
