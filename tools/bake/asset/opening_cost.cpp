#include "bake/asset/opening_cost.hpp"

#include <cstdio>

#include "firmtouch/curve/layout.hpp"
#include "firmtouch/field/layout.hpp"
#include "firmtouch/hull/layout.hpp"
#include "firmtouch/mesh/layout.hpp"
#include "firmtouch/spline/layout.hpp"

namespace firmtouch::tools {
namespace {

constexpr double kPerByte = 2.95;  // of its CRC

struct Rate {
  uint32_t type;
  double per_byte;  // of its proof, or of what is proven with it
};
constexpr Rate kRates[] = {
    {mesh::kTriangles16Section, 23}, {mesh::kTriangles32Section, 11.5},
    {mesh::kNodesSection, 7.9},      {mesh::kLeafBoxesSection, 17},
    {mesh::kProbesSection, 640},     {hull::kStarBoxesSection, 333},
    {hull::kBaseHullSection, 138},   {hull::kProbesSection, 1980},
    {spline::kProbesSection, 400},   {field::kDistancesSection, 2200},
};

// Pieces between samples.
double of_curve(core::Bytes head, core::Bytes samples) {
  const bool is_smooth = reinterpret_cast<const curve::Head*>(head.data())->is_smooth == 1;
  return is_smooth ? 1.8e6 + 105.0 * samples.size() : 3e5 + 57.0 * samples.size();
}

// With weights there are four numbers a control point: a quarter more bytes than without.
double of_spline(const asset::Container& asset, const char* name) {
  const double pieces =
      static_cast<double>(asset.find(spline::kPiecesSection, name).size() / sizeof(spline::Piece));
  const auto coefficients =
      static_cast<double>(asset.find(spline::kCoefficientsSection, name).size());
  const bool is_curve = !asset.find(spline::kArcsSection, name).empty();
  const bool has_weights = coefficients > (is_curve ? 56 : 224) * pieces;
  if (is_curve) return (has_weights ? 2950 : 2150) * coefficients;
  return (has_weights ? 57000.0 : 20000.0) * asset.find(spline::kRadiiSection, name).size();
}

}  // namespace

double instructions_to_open(const asset::Container& asset) {
  double sum = kPerByte * asset.bytes().size();
  for (uint32_t i = 0; i < asset.section_count(); ++i) {
    const uint32_t type = asset.type(i);
    for (const Rate& rate : kRates)
      if (rate.type == type) sum += rate.per_byte * asset.section(i).size();
    if (type == curve::kHeadSection)
      sum += of_curve(asset.section(i), asset.find(curve::kSamplesSection, asset.name(i)));
    if (type == spline::kHeadSection) sum += of_spline(asset, asset.name(i));
  }
  return sum;
}

std::string opening_cost_text(const asset::Container& asset) {
  char text[96];
  const double cost = instructions_to_open(asset);
  std::snprintf(text, sizeof text,
                "opens in about %.1f M instructions of a Cortex-M7: %.2g s at 200 MHz", cost * 1e-6,
                cost / 200e6);
  return text;
}

}  // namespace firmtouch::tools
