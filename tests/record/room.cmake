find_package(Threads REQUIRED)
firmtouch_test_room(record LINKS firmtouch_record firmtouch_core Threads::Threads)

# The same tests under ThreadSanitizer, where the compiler has it: it knows the memory model, the machine that runs the
# plain test shows only its own.
include(CheckCXXSourceCompiles)
set(CMAKE_REQUIRED_FLAGS -fsanitize=thread)
check_cxx_source_compiles("int main() { return 0; }" FIRMTOUCH_HAS_THREAD_SANITIZER)
unset(CMAKE_REQUIRED_FLAGS)
if(FIRMTOUCH_HAS_THREAD_SANITIZER AND NOT CMAKE_CXX_FLAGS MATCHES sanitize)
  add_executable(test_record_tsan record/ring_threads_host_test.cpp harness/test.cpp harness/host_main.cpp)
  target_include_directories(test_record_tsan PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(test_record_tsan PRIVATE firmtouch_record firmtouch_core Threads::Threads)
  firmtouch_hosted(test_record_tsan)
  target_compile_options(test_record_tsan PRIVATE -fsanitize=thread)
  target_link_options(test_record_tsan PRIVATE -fsanitize=thread)
  add_test(NAME record.ThreadSanitizerFindsNoRace COMMAND test_record_tsan)
endif()
