# NUCLEO-H743ZI2: STM32H743ZI, Cortex-M7.
set(FIRMTOUCH_CPU_FLAGS "-mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-sp-d16")
