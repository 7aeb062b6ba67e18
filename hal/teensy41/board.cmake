# Teensy 4.1: i.MX RT1062, Cortex-M7. Its double precision is not used, as on every board.
set(FIRMTOUCH_CPU_FLAGS "-mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-sp-d16")
