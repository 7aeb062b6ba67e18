find_package(Threads REQUIRED)
firmtouch_test_module(core LINKS firmtouch_core Threads::Threads)
set_tests_properties(core.Handoff_TwoThreads_TearNoRequestOrResult PROPERTIES TIMEOUT 7200)  # --long
