#pragma once
#include <stdint.h>

#include "firmtouch/asset/loader.hpp"
#include "firmtouch/controller/asset_loading.hpp"
#include "firmtouch/core/one_of.hpp"

namespace firmtouch {

/// Some loaders (asset/loading.hpp) of one geometry: the first is needed, the others load what the
/// asset has of the same name.
template <class First, class... Others>
class LoaderChain {
 public:
  using State = core::OneOf<typename First::State, typename Others::State...>;

  static const char* find(const asset::Container& asset, const char* wanted) {
    return First::find(asset, wanted);
  }
  template <class L>
  L& get() {
    return static_cast<Holder<L>&>(loaders_).loader;
  }
  template <class L>
  const L& get() const {
    return static_cast<const Holder<L>&>(loaders_).loader;
  }
  void close() {
    get<First>().close();
    (get<Others>().close(), ...);
  }
  template <class Trust>
  void begin(const asset::Container& asset, const char* name, State&) {
    asset_ = &asset;
    name_ = name;
    at_ = 0;
    is_begun_ = false;
  }
  template <class Trust>
  asset::Progress work(State& state, uint32_t units) {
    asset::Progress progress;
    uint32_t i = 0;
    (void)(work_if<Trust>(i++ == at_, get<First>(), state, units, progress) || ... ||
           work_if<Trust>(i++ == at_, get<Others>(), state, units, progress));
    if (!progress.is_done || !progress.verdict.ok()) return progress;
    is_begun_ = false;
    return {++at_ == 1 + sizeof...(Others), core::kPassed};
  }

 private:
  template <class L>
  struct Holder {
    L loader;
  };
  struct All : Holder<First>, Holder<Others>... {};

  template <class Trust, class L>
  bool work_if(bool is_its_turn, L& loader, State& state, uint32_t units,
               asset::Progress& progress) {
    if (!is_its_turn) return false;
    if (is_begun_) {
      progress = loader.template work<Trust>(state.template get<typename L::State>(), units);
    } else if (L::find(*asset_, name_) == nullptr) {
      progress.is_done = true;  // an option that the asset has not
    } else {
      loader.template begin<Trust>(*asset_, name_, state.template begin<typename L::State>());
      is_begun_ = true;
    }
    return true;
  }

  All loaders_;
  const asset::Container* asset_ = nullptr;
  const char* name_ = nullptr;
  uint8_t at_ = 0;
  bool is_begun_ = false;
};

template <class Only>
class LoaderChain<Only> : public Only {
 public:
  template <class L>
  const L& get() const {
    return *this;
  }
};

/// Loads an asset for parts that run in turn: finds what each uses, then proves it and runs its
/// probe queries. `Trust`: asset::Proven. A part is a policy of surfaces or guides (first_of.hpp)
/// or of devices. All proofs share one state.
template <class Trust, class... Parts>
class Loaders : public AssetLoading {
 public:
  static constexpr uint32_t kLinkedParts = (Parts::kParts | ... | 0u);

  /// Starts to load. `asset` must outlive the parts' views.
  void begin(core::Bytes asset, Selection selection, Parts&... parts) {
    begin_frame(selection);
    (parts.close(), ...);
    at_ = 0;
    is_begun_ = false;
    state_.template begin<asset::Opening>(asset);
  }

  /// Checks elements of at most `units` together, or one that takes more (query/staged_check.hpp),
  /// or runs one probe query.
  /// Result: true when it ended.
  bool work(uint32_t units, Parts&... parts) {
    if (stage() == Stage::kFrame) {
      if (work_frame(state_.template get<asset::Opening>(), units, kLinkedParts) &&
          stage() == Stage::kParts)
        find(parts...);
    } else if (stage() == Stage::kParts) {
      uint32_t i = 0;
      (void)(work_if(i++ == at_, parts, units) || ...);
      if (stage() == Stage::kParts && at_ == sizeof...(Parts)) end(core::kPassed);
    }
    return is_ready() || is_refused();
  }

 private:
  template <class P>
  static constexpr bool kIsDevice = __is_base_of(DevicePolicy, P);

  template <class P>
  const char* selected() const {
    if constexpr (kIsDevice<P>)
      return nullptr;
    else
      return P::kIsGuide ? selection().guide : selection().surface;
  }
  template <class P>
  bool find_one(P& part, bool& is_any) {
    if constexpr (!kIsDevice<P>) return find_geometry(part, is_any);
    return true;
  }
  template <class P>
  bool find_geometry(P& part, bool& is_any) {
    const char* name = part.find(container(), selected<P>());
    if (name != nullptr) is_any = true;
    if (name != nullptr || selected<P>() == nullptr) return true;
    end(core::reject(P::kIsGuide ? kRuleNoSuchGuide : kRuleNoSuchSurface));
    return false;
  }
  void find(Parts&... parts) {
    bool is_any = false;
    if (!(find_one(parts, is_any) && ...)) return;
    if (!is_any) end(core::reject(kRuleEmptyScene));
  }
  template <class P>
  bool work_if(bool is_its_turn, P& part, uint32_t units) {
    if (!is_its_turn) return false;
    const char* name = is_begun_ ? nullptr : part.find(container(), selected<P>());
    asset::Progress progress;
    if (is_begun_) {
      progress = part.template work<Trust>(state_.template get<typename P::State>(), units);
    } else if (name == nullptr) {
      progress.is_done = true;
    } else {
      part.template begin<Trust>(container(), name, state_.template begin<typename P::State>());
      is_begun_ = true;
    }
    if (!progress.is_done) return true;
    if (!progress.verdict.ok()) end(progress.verdict);
    is_begun_ = false;
    ++at_;
    return true;
  }

  core::OneOf<asset::Opening, typename Parts::State...> state_;
  uint8_t at_ = 0;
  bool is_begun_ = false;
};

}  // namespace firmtouch
