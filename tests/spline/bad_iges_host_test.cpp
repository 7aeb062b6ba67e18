// Bad IGES: refused with file, line, entity and remedy.
#include "harness/damage.hpp"
#include "iges_text.hpp"
#include "spline/orientation.hpp"

namespace {

using namespace firmtouch;
using namespace firmtouch::spline_test;

bool refused_text(const std::string& text, std::initializer_list<const char*> parts) {
  return refused(tools::read_spline_bytes(text, "part.igs", 0), parts);
}

bool refused_entity(const IgesEntity& entity, std::initializer_list<const char*> parts) {
  return refused(read_entities({entity}), parts);
}

// The arch with `from` replaced by `to`.
bool refused_arch(const std::string& from, const std::string& to,
                  std::initializer_list<const char*> parts) {
  std::string text = arch();
  text.replace(text.find(from), from.size(), to);
  return refused_entity({126, text}, parts);
}

bool refused_sheet(const std::string& from, const std::string& to,
                   std::initializer_list<const char*> parts) {
  std::string text = sheet();
  text.replace(text.find(from), from.size(), to);
  return refused_entity({128, text}, parts);
}

bool refused_global(const std::string& global, std::initializer_list<const char*> parts) {
  return refused_text(IgesText({{126, arch()}}, global).text(), parts);
}

void survive(const char* name, const std::string& bytes) {
  tools::SplineModel model = tools::read_spline_bytes(bytes, name, 0);
  if (!model.problem.empty()) CHECK(has(model.problem, name));
  orient(model);  // whatever the surfaces are
  for (const tools::SplineCurve& c : model.curves) CHECK(!bezier_pieces(c).empty());
  for (const tools::SplineSurface& s : model.surfaces) CHECK(!bezier_pieces(s).empty());
}

}  // namespace

TEST(BadKnotsAreRefusedWithEntityLineAndRemedy) {
  CHECK(refused_arch("0.,0.,0.,0.,1.,1.,1.,1.", "0.,0.,0.,0.,1.,.5,1.,1.",
                     {"part.igs:5:", "entity 126 in line 3", "knot 5 (from 0), 0.5,",
                      "less than the one before, 1", "must not decrease", "export"}));
  CHECK(refused_arch("126,3,3,1,0,1,0,0.,0.,0.,0.,1.,1.,1.,1.,",
                     "126,3,1,1,0,1,0,0.,0.,1.,1.,1.,2.,",
                     {"knot 4 (from 0), 1, stands 3 times", "degree 1 allows 2", "cut it in two"}));
  CHECK(refused_arch("0.,0.,0.,0.,1.,1.,1.,1.", "0.,0.,0.,nan,1.,1.,1.,1.",
                     {"part.igs:5:", "knot 3 (from 0), `nan`, is not finite", "export"}));
  CHECK(refused_arch("126,3,3", "126,2,3", {"3 control points, but degree 3 needs at least 4"}));
  CHECK(refused_arch("126,3,3", "126,3,6", {"degree is 6", "1 to 5", "approximate"}));
  CHECK(refused_arch("126,3,3", "126,3,0", {"degree is 0", "1 to 5"}));
  CHECK(refused_sheet("0.,0.,1.,1.,0.,0.,1.,1.", "0.,0.,1.,1.,0.,2.,1.,1.",
                      {"entity 128 in line 3", "v knot 2", "must not decrease"}));
}

TEST(AKnotThatStandsTooOftenIsRefusedWhereverItStands) {
  // A quadratic of five points: its first, an inner and its last knot, each four times.
  const std::string points =
      "1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,2.,1.,0.,3.,0.,0.,4.,1.,0.,0.,3.,0.,0.,1.;";
  const struct {
    const char *knots, *where;
  } cases[] = {{"0.,0.,0.,0.,1.,2.,3.,3.,", "knot 3 (from 0), 0, stands 4 times"},
               {"0.,0.,1.,1.,1.,1.,2.,3.,", "knot 5 (from 0), 1, stands 4 times"},
               {"0.,0.,1.,2.,3.,3.,3.,3.,", "knot 7 (from 0), 3, stands 4 times"}};
  for (const auto& c : cases)
    CHECK(refused_entity({126, "126,4,2,0,0,1,0," + std::string(c.knots) + points},
                         {"part.igs:", "entity 126 in line 3", c.where, "degree 2 allows 3",
                          "remove repeated knots"}));
  // Three times, as degree 2 allows, is read.
  CHECK(
      read_entities({{126, "126,4,2,0,0,1,0,0.,0.,0.,1.,2.,3.,3.,3.," + points}}).problem.empty());
  CHECK(refused_sheet("0.,0.,1.,1.,0.,0.,1.,1.", "0.,0.,0.,1.,0.,0.,1.,1.",
                      {"entity 128 in line 3", "u knot 2", "stands 3 times", "degree 1 allows 2"}));
  CHECK(refused_sheet("0.,0.,1.,1.,0.,0.,1.,1.", "0.,0.,1.,1.,0.,1.,1.,1.",
                      {"entity 128 in line 3", "v knot 3", "stands 3 times", "remove"}));
}

TEST(BadWeightsAreRefused) {
  CHECK(refused_arch("1.,1.,1.,1.,1.,1.,1.,1.", "1.,1.,1.,1.,1.,1.,0.,1.",
                     {"part.igs:5:", "entity 126", "weight 2 (from 0) is 0", "greater than 0"}));
  CHECK(refused_arch("1.,1.,1.,1.,1.,1.,1.,1.", "1.,1.,1.,1.,-1.,1.,1.,1.", {"weight 0", "is -1"}));
  CHECK(refused_arch("1.,1.,1.,1.,1.,1.,1.,1.", "1.,1.,1.,1.,1.,1E7,1.,1.", {"factor of", "1e6"}));
  CHECK(refused_arch("1.,1.,1.,1.,1.,1.,1.,1.", "1.,1.,1.,1.,1.,INF,1.,1.", {"weight 1", "`INF`"}));
  CHECK(refused_sheet("1.,1.,1.,1.,0.,0.,0.", "1.,1.,0.,1.,0.,0.,0.",
                      {"part.igs:", "entity 128", "weight 2 (from 0) is 0", "greater than 0"}));
  CHECK(refused_sheet("1.,1.,1.,1.,0.,0.,0.", "1.,-2.,1.,1.,0.,0.,0.", {"weight 1", "is -2"}));
  CHECK(refused_sheet("1.,1.,1.,1.,0.,0.,0.", "1.,1.,1.,nan,0.,0.,0.", {"weight 3", "`nan`"}));
}

TEST(BadCoordinatesAreRefused) {
  CHECK(refused_arch("0.1,0.2", "nan,0.2", {"part.igs:5:", "coordinate 3", "`nan`", "export"}));
  CHECK(refused_arch("0.1,0.2", "1e9999,0.2", {"coordinate 3", "too large"}));
  CHECK(refused_arch("0.1,0.2", "2e9,0.2", {"part.igs:5:", "control point 1", "1e9 m", "unit"}));
  CHECK(refused_arch("0.1,0.2", "0.1x,0.2", {"coordinate 3", "`0.1x`", "is not a number"}));
  CHECK(refused_arch("0.1,0.2", "3Habc,0.2", {"coordinate 3", "is a text"}));
  CHECK(refused_arch("0.1,0.2", ",0.2", {"coordinate 3", "is missing", "field is empty"}));
}

TEST(ACurveOrSurfaceWithoutLengthIsRefused) {
  const std::string point = "126,1,1,1,0,1,0,0.,0.,1.,1.,1.,1.,1.,2.,3.,1.,2.,3.,0.,1.,0.,0.,1.;";
  CHECK(refused_entity({126, point}, {"part.igs:3:", "entity 126", "no length", "remove it"}));
  CHECK(refused_entity({128,
                        "128,1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,0.,0.,"
                        "0.,0.,0.,0.,0.,0.,0.,0.,1.,0.,1.;"},
                       {"entity 128", "no extent"}));
}

TEST(RangesOutsideTheKnotsAreRefused) {
  CHECK(refused_arch("0.,1.,0.,0.,1.;", "0.,1.5,0.,0.,1.;", {"used from 0 to 1.5", "0 to 1:"}));
  CHECK(refused_arch("0.,1.,0.,0.,1.;", "1.,0.,0.,0.,1.;", {"used from 1 to 0"}));
}

TEST(ParametersThatEndEarlyAreRefused) {
  CHECK(refused_arch("0.3,0.,0.,0.,1.,0.,0.,1.;", "0.3;",
                     {"part.igs:6:", "coordinate 10", "is missing", "end before it"}));
  std::string text = arch();
  text.pop_back();
  CHECK(refused_entity({126, text + ","}, {"entity 126", "cut short"}));
  CHECK(refused_entity({126, "126,99999,3,0,0,0,0,0.,0.,0.,0.;"}, {"knot 4", "is missing"}));
  CHECK(refused_entity({126, "126,-1,3,0,0,0,0;"}, {"the last index, `-1`,"}));
}

TEST(LinesOfAnotherLengthAreRefused) {
  IgesText file({{126, arch()}});
  file.lines()[3].erase(20, 1);
  CHECK(refused_text(file.text(), {"part.igs:4:", "79 columns", "has 80", "export"}));
  IgesText longer({{126, arch()}});
  longer.lines()[0] += " ";
  CHECK(refused_text(longer.text(), {"part.igs:1:", "81 columns"}));
  CHECK(refused_text("solid x\n", {"part.igs:1:", "no IGES file"}));
}

TEST(TruncatedFilesAreRefusedAtEveryByte) {
  const std::string text = IgesText({{126, arch()}, {128, sheet()}}).text();
  for (size_t length = 0; length + 1 < text.size(); ++length) {
    test::note("length", static_cast<int64_t>(length));
    CHECK(!tools::read_spline_bytes(text.substr(0, length), "part.igs", 0).problem.empty());
  }
}

TEST(MissingAndMovedLinesAreRefused) {
  const IgesText good({{126, arch()}, {128, sheet()}});
  for (size_t i = 0; i < IgesText(good).lines().size(); ++i) {
    test::note("line", static_cast<int64_t>(i));
    IgesText file(good);
    file.lines().erase(file.lines().begin() + static_cast<long>(i));
    CHECK(refused_text(file.text(), {"export"}));
  }
  IgesText file(good);
  std::swap(file.lines()[8], file.lines()[9]);
  CHECK(refused_text(file.text(), {"part.igs:9:", "lines are missing or moved"}));
}

TEST(PointersThatLeadNowhereAreRefused) {
  IgesText file({{126, arch()}});
  file.lines()[2].replace(8, 8, "      99");
  CHECK(refused_text(file.text(), {"part.igs:3:", "points to parameter lines 99", "export"}));
  CHECK(refused_entity({126, arch(), 7}, {"placed by D 7", "no transformation (124)"}));
  CHECK(refused_entity({126, arch(), 1}, {"placed by D 1", "no transformation"}));
  CHECK(refused(
      read_entities({{126, arch(), 3}, {124, "124,1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.;", 3}}),
      {"part.igs:5:", "entity 124", "placed by itself"}));
  CHECK(
      refused(read_entities({{126, arch(), 3}, {124, "124,1.,0.,0.,0.,0.,1.,0.,0.,0.,1.,0.,0.;"}}),
              {"entity 124", "flattens"}));
  IgesText owner({{126, arch()}});
  owner.lines()[4].replace(64, 8, "       5");
  CHECK(refused_text(owner.text(), {"part.igs:5:", "belongs to D `5`", "D 1"}));
}

TEST(ParentsOfNothing_AndThoseThatMoveAnothersCurve_AreRefused) {
  for (const char* list : {"144,99,0,0,0;", "144,3,0,0,0;", "144,5,0,0,0;"})
    CHECK(refused(read_entities({{128, sheet()}, {144, list}, {126, arch()}}),
                  {"entity 144 in line 5 is made of D", "no surface (128)", "export"}));
  CHECK(refused(read_entities({{126, arch()}, {102, "102,2,1,99;"}}),
                {"entity 102 in line 5 is made of D 99", "no single curve", "export"}));
  CHECK(refused(read_entities({{126, arch()}, {102, "102,2,1;"}}), {"entity 102", "pointer 1"}));
  CHECK(refused(read_entities({{126, arch()}, {102, "102,one;"}}), {"entity 102", "the count"}));
  const char* const shift = "124,1.,0.,0.,1.,0.,1.,0.,2.,0.,0.,1.,3.;";
  CHECK(refused(read_entities({{126, arch()}, {102, "102,1,1;", 5}, {124, shift}}),
                {"entity 102 in line 5 moves entity 126 in line 3", "without a transformation"}));
  CHECK(
      refused(read_entities(
                  {{126, arch(), 0, 10000}, {102, "102,1,1;", 5}, {124, shift}, {102, "102,1,1;"}}),
              {"entity 102 in line 5 moves entity 126", "in another entity"}));
  CHECK(refused(read_entities({{126, arch(), 0, 10000},
                               {102, "102,1,1;", 0, 10000},
                               {102, "102,1,3;", 7},
                               {124, shift}}),
                {"entity 102 in line 7 is made of D 3", "no single curve"}));
}

TEST(BadGlobalSectionsAreRefused) {
  CHECK(refused_global("1H1,1H;,,;", {"part.igs:2:", "delimiters"}));
  CHECK(refused_global("1H,,1H,,,;", {"delimiters"}));
  CHECK(refused_global("1H,,1H;,,,,,32,38,6,308,15,,1.,12,;", {"unit", "12"}));
  CHECK(refused_global("1H,,1H;,,,,,32,38,6,308,15,,1.,3,3HELL;", {"unit", "ELL"}));
  CHECK(refused_global("1H,,1H;,,,,,32,38,6,308,15,,0.,6,;", {"scale"}));
  CHECK(refused_global("1H,,1H;,,,,,32,38,6,308,15,,x,6,;", {"global field 13", "`x`"}));
  CHECK(refused_global("1H,,1H;,99Hab,,,,32,38,6,308,15,,1.,6,;", {"global field 3", "cut short"}));
}

TEST(WhatIsNotReadIsRefusedByEntityWithItsCount) {
  CHECK(
      refused(read_entities({{126, arch()}, {110, "110,0,0,0,1,1,1;"}, {110, "110,0,0,0,1,1,1;"}}),
              {"part.igs:5:", "entity 110 in line 5", "only NURBS curves (126)",
               "2 times, last in line 7"}));
  CHECK(refused_entity({141, "141,0,1,1,1,3,1,0;"}, {"entity 141", "trimmed"}));
  CHECK(refused_entity({142, "142,0,1,0,3,2;"}, {"entity 142", "trimmed"}));
  CHECK(refused(read_entities({{128, sheet()}, {144, "144,1,1,0,5;"}}), {"entity 144", "trimmed"}));
  CHECK(refused_entity({408, "408,1,0.,0.,0.,1.;"}, {"entity 408", "explode"}));
  CHECK(refused_entity({314, "314,1.,2.,3.;"}, {"holds no curve and no surface"}));
}

TEST(OtherFilesAreRefusedByWhatTheyAre) {
  CHECK(refused(tools::read_spline_bytes("", "part.igs", 0), {"is empty"}));
  CHECK(refused(tools::read_spline_bytes("x", "part.stp", 0), {"`stp`", ".igs, .iges or .bpt"}));
  CHECK(has(tools::read_spline_file("no/such.igs", 0).problem, "no/such.igs: cannot be opened"));
  IgesText file({{126, arch()}});
  file.lines()[0][72] = 'C';
  CHECK(refused_text(file.text(), {"compressed or binary", "plain ASCII"}));
  file.lines()[0][72] = 'X';
  CHECK(refused_text(file.text(), {"column 73 holds `X`"}));
}

TEST(DamagedModel_Iges_EndsInAProblemOrASpline) {
  const std::string good =
      IgesText(
          {{126, arch(), 5}, {128, sheet()}, {124, "124,1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.;"}})
          .text();
  test::attack({good}, [](const std::string& bytes) { survive("part.igs", bytes); });
}
TEST(DamagedModel_Bpt_EndsInAProblemOrASpline) {
  std::string good = "1\n1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16\n16\n";
  for (int i = 0; i < 16; ++i)
    good += std::to_string(i % 4) + "," + std::to_string(i / 4) + ",0.5\n";
  test::attack({good}, [](const std::string& bytes) { survive("part.bpt", bytes); });
}
