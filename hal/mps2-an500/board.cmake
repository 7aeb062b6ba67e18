# Arm MPS2 with FPGA image AN500: Cortex-M7. Single precision only: a stray double fails to link.
set(FIRMTOUCH_CPU_FLAGS "-mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-sp-d16")
