# QEMU's riscv32 `virt`: RV32IMAFC, single precision.
set(FIRMTOUCH_CPU_FLAGS "-march=rv32imafc -mabi=ilp32f -mcmodel=medany")
