# find_package(firmtouch): firmtouch::core, firmtouch::controller, ..., firmtouch::hal, and firmtouch_bake().
include(${CMAKE_CURRENT_LIST_DIR}/firmtouch-targets.cmake)
if(NOT TARGET firmtouch::libc)
  add_library(firmtouch::libc INTERFACE IMPORTED)
  target_sources(firmtouch::libc INTERFACE $<TARGET_OBJECTS:firmtouch::libc_objects>)
endif()
include(${CMAKE_CURRENT_LIST_DIR}/firmtouch_bake.cmake)
