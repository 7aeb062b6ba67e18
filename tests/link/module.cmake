firmtouch_test_module(link LINKS firmtouch_link firmtouch_record firmtouch_core)
# A hundred million tries (--long).
set_tests_properties(link.Decoder_DamagedStream_ReturnsOnlySentFrames PROPERTIES TIMEOUT 7200)
