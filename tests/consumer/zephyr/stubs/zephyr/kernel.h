#pragma once
#include <cstddef>
#include <cstdint>
// What main.cpp uses of <zephyr/kernel.h>, for a program of this machine (stubs/kernel.cpp).
struct k_thread {};
struct k_timeout_t {};
using k_thread_entry_t = void (*)(void*, void*, void*);
constexpr k_timeout_t K_NO_WAIT;
constexpr uint32_t K_FP_REGS = 2;
#define K_PRIO_PREEMPT(priority) (priority)
#define K_THREAD_STACK_DEFINE(name, bytes) char name[bytes]
#define K_THREAD_STACK_SIZEOF(name) sizeof(name)
void k_thread_create(k_thread* thread, char* stack, size_t bytes, k_thread_entry_t entry, void*,
                     void*, void*, int priority, uint32_t options, k_timeout_t delay);
int32_t k_usleep(int32_t us);
