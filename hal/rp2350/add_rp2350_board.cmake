# firmtouch_add_rp2350_board(BOARD_FOLDER): a board with an RP2350, described by registers.hpp of BOARD_FOLDER.
include(${CMAKE_CURRENT_LIST_DIR}/../silicon/add_silicon_board.cmake)
set(FIRMTOUCH_RP2350 ${CMAKE_CURRENT_LIST_DIR})
function(firmtouch_add_rp2350_board folder)
  set(sources board clock encoders motors)
  list(TRANSFORM sources REPLACE "(.+)" "${FIRMTOUCH_RP2350}/\\1.cpp")
  firmtouch_add_silicon_board(${folder} SOURCES ${sources})
endfunction()
