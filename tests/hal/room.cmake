firmtouch_test_room(hal LINKS firmtouch_core)
