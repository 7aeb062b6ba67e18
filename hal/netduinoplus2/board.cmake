# Netduino Plus 2: STM32F405, Cortex-M4F.
set(FIRMTOUCH_CPU_FLAGS "-mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16")
