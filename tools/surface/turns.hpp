#pragma once

namespace firmtouch::tools {

/// Cosine and sine of an angle in turns, by + and * alone, so that a generated model has the same
/// bytes everywhere.
/// Error: 4e-16 for |turns| <= 1000 (tests/surface/generators_host_test.cpp).
double cosine_of_turns(double turns);
double sine_of_turns(double turns);

}  // namespace firmtouch::tools
