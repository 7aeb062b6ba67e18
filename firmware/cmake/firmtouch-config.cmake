# find_package(firmtouch): firmtouch::core, firmtouch::controller, ..., firmtouch::hal, and firmtouch_bake().
include(${CMAKE_CURRENT_LIST_DIR}/firmtouch-targets.cmake)
if(NOT TARGET firmtouch::libc)
  add_library(firmtouch::libc INTERFACE IMPORTED)
  target_sources(firmtouch::libc INTERFACE $<TARGET_OBJECTS:firmtouch::libc_objects>)
endif()
include(${CMAKE_CURRENT_LIST_DIR}/firmtouch_bake.cmake)
# The baker: installed beside these libraries, or where -DFIRMTOUCH_HOST_TOOLS says. There are no sources to build it from.
if(NOT FIRMTOUCH_HOST_TOOLS)
  find_program(FIRMTOUCH_INSTALLED_PROGRAM firmtouch HINTS ${CMAKE_CURRENT_LIST_DIR}/../../../bin NO_CMAKE_FIND_ROOT_PATH)
  if(FIRMTOUCH_INSTALLED_PROGRAM)
    get_filename_component(FIRMTOUCH_HOST_TOOLS ${FIRMTOUCH_INSTALLED_PROGRAM} DIRECTORY)
  endif()
endif()
