# firmtouch_add_silicon_board(BOARD_FOLDER [SOURCES FILE...] [LINKER_SCRIPT FILE]): a board with encoders, motors and UARTs of
# its own, described by registers.hpp of BOARD_FOLDER. SOURCES and the script (default link.ld) are of that folder unless
# they have a path. An image for hardware: no semihosting, no host can end it.
set(FIRMTOUCH_SILICON ${CMAKE_CURRENT_LIST_DIR})
function(firmtouch_add_silicon_board folder)
  cmake_parse_arguments(board "" "LINKER_SCRIPT" "SOURCES" ${ARGN})
  if(NOT board_LINKER_SCRIPT)
    set(board_LINKER_SCRIPT link.ld)
  endif()
  firmtouch_board_parts(firmtouch_board
    SOURCES ${board_SOURCES} ${FIRMTOUCH_SILICON}/console.cpp ${FIRMTOUCH_SILICON}/cycles.cpp ${FIRMTOUCH_SILICON}/link.cpp
            ${FIRMTOUCH_SILICON}/wiring.cpp
    PARTS firmtouch_cortex_m firmtouch_no_emulator firmtouch_no_parameters LINKER_SCRIPT ${folder}/${board_LINKER_SCRIPT})
  target_include_directories(firmtouch_board_objects PRIVATE ${folder})
endfunction()
