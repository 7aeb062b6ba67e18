# Arm MPS3 with FPGA image AN547: Cortex-M55, scalar code. Single and double precision in hardware: unlike on the other
# boards a stray double links, so tests/check/archives.sh looks for them elsewhere.
set(FIRMTOUCH_CPU_FLAGS "-mcpu=cortex-m55+nomve -mthumb -mfloat-abi=hard -mfpu=auto")
