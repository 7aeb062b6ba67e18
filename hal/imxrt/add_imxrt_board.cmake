# firmtouch_add_imxrt_board(BOARD_FOLDER): a board with an i.MX RT1062, described by registers.hpp of BOARD_FOLDER.
include(${CMAKE_CURRENT_LIST_DIR}/../silicon/add_silicon_board.cmake)
set(FIRMTOUCH_IMXRT ${CMAKE_CURRENT_LIST_DIR})
function(firmtouch_add_imxrt_board folder)
  set(sources board boot clock encoders motors)
  list(TRANSFORM sources REPLACE "(.+)" "${FIRMTOUCH_IMXRT}/\\1.cpp")
  firmtouch_add_silicon_board(${folder} SOURCES ${sources})
endfunction()
