# Toolchain of every Cortex-M board, one of ours or your own:
#
#     cmake -DCMAKE_TOOLCHAIN_FILE=.../hal/cmake/arm-none-eabi.cmake -DFIRMTOUCH_BOARD=mps2-an500 ...
#     cmake -DCMAKE_TOOLCHAIN_FILE=.../hal/cmake/arm-none-eabi.cmake -DFIRMTOUCH_BOARD_DIR=/your/board ...
#
# The board's folder holds board.cmake, which sets FIRMTOUCH_CPU_FLAGS. Or give -DFIRMTOUCH_CPU_FLAGS="-mcpu=..." alone.

set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
if(NOT FIRMTOUCH_GCC)
  set(FIRMTOUCH_GCC arm-none-eabi-g++)
  set(FIRMTOUCH_TRIPLE arm-none-eabi)
endif()
set(CMAKE_CXX_COMPILER ${FIRMTOUCH_GCC} CACHE STRING "C++ compiler of the board")
set(CMAKE_ASM_COMPILER ${CMAKE_CXX_COMPILER})
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)  # without a linker script there is no program to try
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES FIRMTOUCH_BOARD FIRMTOUCH_BOARD_DIR FIRMTOUCH_CPU_FLAGS)

if(FIRMTOUCH_BOARD AND NOT FIRMTOUCH_BOARD_DIR)
  get_filename_component(FIRMTOUCH_BOARD_DIR ${CMAKE_CURRENT_LIST_DIR}/../${FIRMTOUCH_BOARD} ABSOLUTE)
endif()
if(FIRMTOUCH_BOARD_DIR AND NOT FIRMTOUCH_CPU_FLAGS)
  if(NOT EXISTS ${FIRMTOUCH_BOARD_DIR}/board.cmake)
    message(FATAL_ERROR "No board.cmake in ${FIRMTOUCH_BOARD_DIR}. Set FIRMTOUCH_BOARD to a folder of hal, or "
                        "FIRMTOUCH_BOARD_DIR to your board's folder (hal/PORTING.md).")
  endif()
  include(${FIRMTOUCH_BOARD_DIR}/board.cmake)
endif()
if(NOT FIRMTOUCH_CPU_FLAGS)
  message(FATAL_ERROR "Which controller? Give FIRMTOUCH_BOARD, FIRMTOUCH_BOARD_DIR or FIRMTOUCH_CPU_FLAGS.")
endif()

# GCC, or clang with lld and GCC's libgcc: -DCMAKE_CXX_COMPILER=clang++-14. GCC writes a call graph with stack sizes next to
# each object; tools/check/stack.cpp joins them.
if(CMAKE_CXX_COMPILER MATCHES clang)
  separate_arguments(flags UNIX_COMMAND "${FIRMTOUCH_CPU_FLAGS}")
  execute_process(COMMAND ${FIRMTOUCH_GCC} ${flags} -print-libgcc-file-name OUTPUT_VARIABLE libgcc OUTPUT_STRIP_TRAILING_WHITESPACE)
  set(CMAKE_CXX_FLAGS_INIT "--target=${FIRMTOUCH_TRIPLE} ${FIRMTOUCH_CPU_FLAGS}")
  set(CMAKE_EXE_LINKER_FLAGS_INIT "-nostdlib -fuse-ld=lld -Wl,--gc-sections")
  set(CMAKE_CXX_STANDARD_LIBRARIES "${libgcc}")
else()
  set(CMAKE_CXX_FLAGS_INIT "${FIRMTOUCH_CPU_FLAGS} -fcallgraph-info=su,da")
  set(CMAKE_EXE_LINKER_FLAGS_INIT "-nostdlib -Wl,--gc-sections")
  set(CMAKE_CXX_STANDARD_LIBRARIES "-lgcc")  # integer division and the like; last on the line
endif()
set(CMAKE_ASM_FLAGS_INIT "${FIRMTOUCH_CPU_FLAGS}")

set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
