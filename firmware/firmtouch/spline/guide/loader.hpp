#pragma once
#include "firmtouch/asset/loader.hpp"
#include "firmtouch/spline/curve/closest_on_curve.hpp"
#include "firmtouch/spline/guide/view.hpp"
#include "firmtouch/spline/proof/opening.hpp"
#include "firmtouch/spline/proof/sections.hpp"

namespace firmtouch::spline {

/// Proves spline curves, then the lengths that a guide needs, and runs their probe queries.
class GuideLoader : private asset::Prover<Proof>,
                    private asset::Prover<GuideProof>,
                    private asset::Probing<CurveProbeRun, kRuleSplineProbes> {
 public:
  using State = core::OneOf<Opening, GuideOpening, CurveProbeRun>;
  static const char* find(const asset::Container& asset, const char* wanted) {
    return find_kind(asset, wanted, false);
  }
  void close() {
    Prover<Proof>::close();
    Prover<GuideProof>::close();
  }
  /// Open once proven.
  const GuideView& view() const { return Prover<GuideProof>::view(); }

  template <class Trust>
  void begin(const asset::Container& asset, const char* name, State& state) {
    close();
    find_probes(asset, kProbesSection, name);
    lengths_ = asset::find_sections<GuideSections>(asset, name);
    state.begin<typename Trust::template Opening<Proof>>(
        asset::find_sections<Sections>(asset, name));
  }
  template <class Trust>
  asset::Progress work(State& state, uint32_t units) {
    if (view().is_open()) return work_probe(state, model());
    if (model().is_open()) {
      const asset::Progress proof = Prover<GuideProof>::work_proof<Trust>(state, units);
      return view().is_open() ? begin_probes(state) : proof;
    }
    const asset::Progress proof = Prover<Proof>::work_proof<Trust>(state, units);
    if (!model().is_open()) return proof;
    state.begin<typename Trust::template Opening<GuideProof>>(model(), lengths_);
    return {};
  }

 private:
  const View& model() const { return Prover<Proof>::view(); }

  GuideSections lengths_;
};

}  // namespace firmtouch::spline
