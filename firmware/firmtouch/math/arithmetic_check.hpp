#pragma once

namespace firmtouch::math {

/// Whether this processor, as it is set up now, computes float32 as the baker's machine did:
/// rounding to nearest even, denormals kept, no extra precision, products not fused into sums,
/// square roots correctly rounded, NaN outside every limit, sums and quotients as they are written.
/// Bounds: about 420 instructions. The flags checked are those that the library was built with.
bool arithmetic_is_sound();

}  // namespace firmtouch::math
