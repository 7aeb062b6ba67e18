# Arm MPS2 with FPGA image AN505: Cortex-M33.
set(FIRMTOUCH_CPU_FLAGS "-mcpu=cortex-m33 -mthumb -mfloat-abi=hard -mfpu=fpv5-sp-d16")
