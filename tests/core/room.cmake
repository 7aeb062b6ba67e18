firmtouch_test_room(core LINKS firmtouch_core)
