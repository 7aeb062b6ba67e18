#pragma once
#include "firmtouch/asset/loading.hpp"
#include "firmtouch/core/one_of.hpp"
#include "firmtouch/query/probe.hpp"
#include "firmtouch/query/staged_check.hpp"

namespace firmtouch::asset {

/// The sections of the geometry `name`. One that the asset lacks is empty.
/// Bounds: a search of the section table each; no memory is copied.
template <class Sections>
[[gnu::noinline]] Sections find_sections(const Container& asset, const char* name) {
  Sections sections;
  sections.each([&](uint32_t type, core::Bytes& bytes) { bytes = asset.find(type, name); });
  return sections;
}

/// Proves the geometry `name` at once.
template <class View>
core::Verdict open_geometry(const Container& asset, const char* name, View& view) {
  return open(find_sections<typename View::Sections>(asset, name), view);
}

/// By what a loader takes a geometry's sections: it proves them. The parameter `Trust` of loaders.
struct Proven {
  template <class Proof>
  using Opening = query::Opening<Proof>;
};

/// It does not: for an asset whose signature the boot loader has checked, and no other. CRCs and
/// probe queries are checked as ever.
struct Trusted {
  template <class Proof>
  using Opening = query::Unproven<Proof>;
};

/// The loader of what needs no section of an asset.
class LoadsNothing {
 public:
  using State = core::OneOf<uint32_t>;
  void close() {}
  template <class Trust>
  void begin(const Container&, const char*, State&) {}
  template <class Trust>
  Progress work(State&, uint32_t) {
    return {true, core::kPassed};
  }
};

/// The first step of every loader: from sections to a view.
template <class Proof>
class Prover {
 public:
  void close() { view_ = {}; }
  /// Open once proven.
  const decltype(Proof::view)& view() const { return view_; }

 protected:
  template <class Trust, class State>
  Progress work_proof(State& state, uint32_t units) {
    auto& opening = state.template get<typename Trust::template Opening<Proof>>();
    opening.work(units);
    if (opening.done()) view_ = opening.view();
    return {opening.done(), opening.verdict()};
  }

 private:
  decltype(Proof::view) view_;
};

/// The last step of a loader: probe queries, one a slice, and a rule for other answers.
template <class ProbeRun, uint16_t kRule>
class Probing {
 protected:
  void find_probes(const Container& asset, uint32_t type, const char* name) {
    section_ = asset.find(type, name);
  }
  template <class State>
  Progress begin_probes(State& state) const {
    const query::Probes probes = query::read_probes(section_);
    if (!query::is_sensible(probes)) return {true, core::reject(kRule)};
    state.template begin<ProbeRun>(probes);
    return {};
  }
  template <class State, class View>
  Progress work_probe(State& state, const View& view) const {
    ProbeRun& run = state.template get<ProbeRun>();
    run.work(view);
    return {run.done(), run.done() && !run.agrees() ? core::reject(kRule) : core::kPassed};
  }

 private:
  core::Bytes section_;
};

/// Proves one geometry of an asset and runs its probe queries (loading.hpp).
template <class Proof, class ProbeRun, uint32_t kHeadSection, uint32_t kProbesSection,
          uint16_t kRuleProbes>
class Loader : public Prover<Proof>, private Probing<ProbeRun, kRuleProbes> {
 public:
  using State = core::OneOf<query::Opening<Proof>, ProbeRun>;

  static const char* find(const Container& asset, const char* wanted) {
    return find_name(asset, kHeadSection, wanted);
  }
  template <class Trust>
  void begin(const Container& asset, const char* name, State& state) {
    this->close();
    this->find_probes(asset, kProbesSection, name);
    state.template begin<typename Trust::template Opening<Proof>>(
        find_sections<typename decltype(Proof::view)::Sections>(asset, name));
  }
  template <class Trust>
  Progress work(State& state, uint32_t units) {
    if (this->view().is_open()) return this->work_probe(state, this->view());
    const Progress proof = this->template work_proof<Trust>(state, units);
    return this->view().is_open() ? this->begin_probes(state) : proof;
  }
};

/// Proves what the asset has beside a geometry, of the same name. Its proof has no probes.
template <class Proof, uint32_t kSection, class Geometry>
class PartLoader : public Prover<Proof> {
 public:
  using State = core::OneOf<query::Opening<Proof>>;

  static const char* find(const Container& asset, const char* wanted) {
    return find_name(asset, kSection, wanted);
  }
  /// Before begin(). `geometry` is open by then, and outlives the loader.
  void prove_against(const Geometry& geometry) { geometry_ = &geometry; }
  template <class Trust>
  void begin(const Container& asset, const char* name, State& state) {
    state.template begin<typename Trust::template Opening<Proof>>(
        find_sections<typename decltype(Proof::view)::Sections>(asset, name), *geometry_);
  }
  template <class Trust>
  Progress work(State& state, uint32_t units) {
    return this->template work_proof<Trust>(state, units);
  }

 private:
  const Geometry* geometry_ = nullptr;
};

}  // namespace firmtouch::asset
