# firmtouch_add_cmsdk_board(BOARD_FOLDER [PART...]): a board with Arm's CMSDK peripherals, described by board.cpp and
# registers.hpp of BOARD_FOLDER.
function(firmtouch_add_cmsdk_board folder)
  set(cmsdk ${CMAKE_CURRENT_FUNCTION_LIST_DIR})
  firmtouch_add_board(
    SOURCES ${folder}/board.cpp ${cmsdk}/board.cpp ${cmsdk}/clock.cpp ${cmsdk}/../silicon/console.cpp ${cmsdk}/../silicon/link.cpp
            ${cmsdk}/../parts/memory_parameters.cpp
    PARTS firmtouch_cortex_m firmtouch_no_joints ${ARGN})
  target_include_directories(firmtouch_board_objects PRIVATE ${folder})
endfunction()
