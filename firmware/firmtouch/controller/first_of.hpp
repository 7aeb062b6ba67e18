#pragma once
#include <stdint.h>

#include "firmtouch/asset/loader.hpp"
#include "firmtouch/controller/model.hpp"
#include "firmtouch/core/one_of.hpp"
#include "firmtouch/params/compose.hpp"
#include "firmtouch/scene/texture.hpp"

namespace firmtouch {

/// Several policies of one kind, all surfaces or all guides, of which the first that the asset has
/// is used. It has the shape of a policy itself.
template <class... Policies>
class FirstOf : private Policies... {
  static_assert(sizeof...(Policies) > 0, "name a policy");

 public:
  using State = core::OneOf<typename Policies::State...>;
  static constexpr uint32_t kParts = (Policies::kParts | ... | 0u);

  template <class P>
  P& get() {
    return *this;
  }
  template <class P>
  const P& get() const {
    return *this;
  }
  void reset() { (Policies::reset(), ...); }
  void close() { (Policies::close(), ...); }
  bool is_open() const { return (Policies::is_open() || ...); }

  static const char* find(const asset::Container& asset, const char* wanted) {
    const char* name = nullptr;
    (void)(((name = Policies::find(asset, wanted)) != nullptr) || ...);
    return name;
  }
  template <class Trust>
  void begin(const asset::Container& asset, const char* name, State& state) {
    at_ = 0;
    (void)(begin_if<Trust, Policies>(asset, name, state) || ...);
  }
  template <class Trust>
  asset::Progress work(State& state, uint32_t units) {
    asset::Progress progress;
    uint8_t i = 0;
    (void)((i++ == at_ && (progress = Policies::template work<Trust>(
                               state.template get<typename Policies::State>(), units),
                           true)) ||
           ...);
    return progress;
  }

 protected:
  /// Calls `use` with the policy that is open.
  /// Result: false if none is.
  template <class Use>
  bool use_open(const Use& use) {
    return ((Policies::is_open() && (use(static_cast<Policies&>(*this)), true)) || ...);
  }

 private:
  template <class Trust, class P>
  bool begin_if(const asset::Container& asset, const char* name, State& state) {
    if (P::find(asset, name) == nullptr) {
      ++at_;
      return false;
    }
    P::template begin<Trust>(asset, name, state.template begin<typename P::State>());
    return true;
  }

  uint8_t at_ = 0;
};

/// Base of the policies of surfaces that move: they have take_command() and advance().
struct MovingSurface {};

/// Base of those that turn the handle of a tool: they have begin_torque() and put_torque(), too.
struct TorqueSurface : MovingSurface {};

/// Base of those that may have textures: they have a stiffening().
struct TexturedSurface {};

/// The surfaces of a controller: the first that the asset has is touched.
template <class... Policies>
class Surfaces : public FirstOf<Policies...> {
  static_assert((!Policies::kIsGuide && ...), "guides are the controller's second argument");

 public:
  static constexpr bool kIsGuide = false;
  using Parameters = params::Joined<typename Policies::Parameters...>;

  static constexpr bool kHasTextures = (__is_base_of(TexturedSurface, Policies) || ...);
  static constexpr bool kMoves = (__is_base_of(MovingSurface, Policies) || ...);
  static constexpr bool kHasTorque = (__is_base_of(TorqueSurface, Policies) || ...);

  void touch(const ModelRequest& request, const params::Values& values, ModelResult& result) {
    this->use_open([&](auto& surface) { surface.touch(request, values, result); });
  }
  /// Of the surface that moves, if the asset has it: a command that is no parameter's.
  /// Result: false if it is refused.
  bool take_command(uint32_t command, float value) {
    bool is_taken = false;
    use_kind<MovingSurface>(
        [&](auto& surface) { is_taken = surface.take_command(command, value); });
    return is_taken;
  }
  /// Of the surface that has textures, if the asset has it.
  scene::Stiffening stiffening() {
    scene::Stiffening by;
    this->use_open([&](auto& surface) { stiffen(surface, by); });
    return by;
  }
  void advance(float passed_s) {
    use_kind<MovingSurface>([&](auto& surface) { surface.advance(passed_s); });
  }
  /// Of the surface whose tool has a handle.
  void begin_torque() {
    use_kind<TorqueSurface>([](auto& surface) { surface.begin_torque(); });
  }
  void put_torque(bool is_new, record::TickOutput& output) {
    use_kind<TorqueSurface>([&](auto& surface) { surface.put_torque(is_new, output); });
  }

 private:
  template <class P>
  static void stiffen(const P& surface, scene::Stiffening& by) {
    if constexpr (__is_base_of(TexturedSurface, P)) by = surface.stiffening();
  }
  // Of the surface in use, if it is a `Kind`.
  template <class Kind, class Use>
  void use_kind(const Use& use) {
    this->use_open([&](auto& surface) { use_if_it_is<Kind>(surface, use); });
  }
  template <class Kind, class P, class Use>
  static void use_if_it_is(P& surface, const Use& use) {
    if constexpr (__is_base_of(Kind, P)) use(surface);
  }
};

/// A guide policy of several: the first that the asset has is followed.
template <class... Policies>
class Guides : public FirstOf<Policies...> {
  static_assert((Policies::kIsGuide && ...), "surfaces are the controller's first argument");

 public:
  static constexpr bool kIsGuide = true;
  using Parameters = params::Joined<typename Policies::Parameters...>;

  void follow(const ModelRequest& request, const params::Values& values, ModelResult& result) {
    this->use_open([&](auto& guide) { guide.follow(request, values, result); });
  }
};

/// The guide policy of a controller without a guide.
class NoGuide : public asset::LoadsNothing {
 public:
  using Parameters = params::Groups<>;
  static constexpr bool kIsGuide = true;
  static constexpr uint32_t kParts = 0;

  static const char* find(const asset::Container&, const char*) { return nullptr; }
  void reset() {}
  void follow(const ModelRequest&, const params::Values&, ModelResult&) {}
};

}  // namespace firmtouch
