# Raspberry Pi Pico 2: RP2350, Cortex-M33 in secure state.
set(FIRMTOUCH_CPU_FLAGS "-mcpu=cortex-m33 -mthumb -mfloat-abi=hard -mfpu=fpv5-sp-d16")
