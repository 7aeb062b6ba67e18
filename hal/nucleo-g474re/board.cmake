# NUCLEO-G474RE: STM32G474RE, Cortex-M4F.
set(FIRMTOUCH_CPU_FLAGS "-mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16")
