# Toolchain of RISC-V boards; otherwise as arm-none-eabi.cmake.
set(FIRMTOUCH_TRIPLE riscv32-unknown-elf)
set(FIRMTOUCH_GCC riscv64-unknown-elf-g++)
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
set(CMAKE_SYSTEM_PROCESSOR riscv32)

# With -flto clang's linker generates the code, and does not take extensions and ABI from its inputs (version 14).
if(CMAKE_CXX_COMPILER MATCHES clang AND FIRMTOUCH_CPU_FLAGS MATCHES "-march=rv32i([a-z]+) .*-mabi=([a-z0-9]+)")
  set(abi ${CMAKE_MATCH_2})
  string(REGEX REPLACE "(.)" ",+\\1" extensions ${CMAKE_MATCH_1})
  string(SUBSTRING ${extensions} 1 -1 extensions)
  string(APPEND CMAKE_EXE_LINKER_FLAGS_INIT
         " -Xlinker -mllvm -Xlinker -mattr=${extensions} -Xlinker -mllvm -Xlinker -target-abi=${abi}")
endif()
