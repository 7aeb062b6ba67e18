# Arm MPS2 with FPGA image AN386: Cortex-M4F.
set(FIRMTOUCH_CPU_FLAGS "-mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16")
