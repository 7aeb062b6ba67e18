# firmtouch_add_stm32_board(BOARD_FOLDER [SOURCES FILE...] [LINKER_SCRIPT FILE]): a board with an STM32 of the newer families
# (G4, H7), described by board.cpp and registers.hpp of BOARD_FOLDER.
include(${CMAKE_CURRENT_LIST_DIR}/../silicon/add_silicon_board.cmake)
set(FIRMTOUCH_STM32 ${CMAKE_CURRENT_LIST_DIR})
function(firmtouch_add_stm32_board folder)
  cmake_parse_arguments(board "" "LINKER_SCRIPT" "SOURCES" ${ARGN})
  list(APPEND board_SOURCES board.cpp)
  foreach(file board clock encoders motors watchdog)
    list(APPEND board_SOURCES ${FIRMTOUCH_STM32}/${file}.cpp)
  endforeach()
  firmtouch_add_silicon_board(${folder} SOURCES ${board_SOURCES} LINKER_SCRIPT "${board_LINKER_SCRIPT}")
endfunction()
