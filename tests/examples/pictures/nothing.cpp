// On a board an example draws nothing.
#include "examples/hand.hpp"

void firmtouch::show(math::Vec3, math::Vec3, float) {}
