# firmtouch_add_stm32_board(BOARD_FOLDER [SOURCES FILE...] [LINKER_SCRIPT FILE]): a board with an STM32 of the newer families
# (G4, H7), described by board.cpp and registers.hpp of BOARD_FOLDER. An image for hardware: no semihosting, no host can end it.
function(firmtouch_add_stm32_board folder)
  cmake_parse_arguments(board "" "LINKER_SCRIPT" "SOURCES" ${ARGN})
  if(NOT board_LINKER_SCRIPT)
    set(board_LINKER_SCRIPT link.ld)
  endif()
  set(stm32 ${CMAKE_CURRENT_FUNCTION_LIST_DIR})
  firmtouch_board_parts(firmtouch_board
    SOURCES ${folder}/board.cpp ${board_SOURCES} ${stm32}/board.cpp ${stm32}/clock.cpp ${stm32}/console.cpp ${stm32}/encoders.cpp
            ${stm32}/link.cpp ${stm32}/motors.cpp ${stm32}/watchdog.cpp ${stm32}/wiring.cpp
    PARTS firmtouch_cortex_m firmtouch_no_emulator firmtouch_no_parameters LINKER_SCRIPT ${folder}/${board_LINKER_SCRIPT})
  target_include_directories(firmtouch_board_objects PRIVATE ${folder})
endfunction()
