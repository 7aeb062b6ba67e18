#include "firmtouch/scene/texture.hpp"

#include "firmtouch/math/sine_cosine.hpp"
#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::scene {

Cut cut_at(const TextureLayout& texture, math::Vec3 x_m) {
  constexpr float kTurn_rad = 6.28318548f;
  Cut cut;
  for (const WaveLayout& wave : texture.wave) {
    if (!(wave.height_m > 0.0f)) continue;
    const math::Vec3 per_m{wave.per_m[0], wave.per_m[1], wave.per_m[2]};
    const float waves = math::dot(per_m, x_m);
    // Adding 1.5 * 2^23 rounds to a whole number.
    const float whole = (waves + 0x1.8p23f) - 0x1.8p23f;
    const math::SineCosine at = math::sine_cosine((waves - whole) * kTurn_rad);
    cut.depth_m += 0.5f * wave.height_m * (1.0f - at.cosine);
    cut.slope = cut.slope + per_m * (0.5f * kTurn_rad * wave.height_m * at.sine);
  }
  return cut;
}

Stiffening stiffening_of(core::Span<const TextureLayout> textures,
                         core::Span<const ReliefLayout> reliefs) {
  constexpr float kPi = 3.14159274f;
  Stiffening most;
  for (uint32_t i = 0; i < textures.size() || i < reliefs.size(); ++i) {
    float slope = 0, per_m = 0;
    if (i < reliefs.size()) slope = reliefs[i].slope, per_m = reliefs[i].per_m;
    for (uint32_t k = 0; k < 2 && i < textures.size(); ++k) {
      const WaveLayout& wave = textures[i].wave[k];
      const math::Vec3 turns{wave.per_m[0], wave.per_m[1], wave.per_m[2]};
      const float square = math::dot(turns, turns);
      slope += kPi * wave.height_m * math::square_root(square);
      per_m += 2.0f * kPi * kPi * wave.height_m * square;
    }
    most.share = math::larger((1.0f + slope) * (1.0f + slope), most.share);
    most.per_m = math::larger(per_m, most.per_m);
  }
  return most;
}

}  // namespace firmtouch::scene
