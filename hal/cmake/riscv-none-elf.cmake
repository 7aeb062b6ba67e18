# Toolchain of RISC-V boards; otherwise as arm-none-eabi.cmake.
set(FIRMTOUCH_TRIPLE riscv32-unknown-elf)
set(FIRMTOUCH_GCC riscv64-unknown-elf-g++)
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
set(CMAKE_SYSTEM_PROCESSOR riscv32)
