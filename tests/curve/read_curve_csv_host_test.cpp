// Curves from files: what is taken, what is mended, what is refused and how that is said.
#include "curve/read_curve_csv.hpp"

#include <clocale>
#include <string>

#include "harness/damage.hpp"

namespace {

using firmtouch::tools::CurvePoints;
using firmtouch::tools::read_curve_csv_bytes;

CurvePoints read(const std::string& text, double unit_m = 1.0) {
  return read_curve_csv_bytes(text, "path.csv", unit_m);
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// Refused, with the file, and every part of the message.
bool refused(const std::string& text, std::initializer_list<const char*> parts) {
  const CurvePoints points = read(text);
  bool good = has(points.problem, "path.csv: ");
  for (const char* part : parts) good = good && has(points.problem, part);
  if (!good) std::printf("      said: %s\n", points.problem.c_str());
  return good;
}

}  // namespace

TEST(RowsBecomeSamplesInOrder) {
  const CurvePoints points = read("x,y,z\n0,0,0\n1,-2.5,3e-3\n+4,5,6\n");
  CHECK(points.problem.empty());
  CHECK_EQ(points.samples_m.size(), 3u);
  CHECK_EQ(points.samples_m[1].y, -2.5f);
  CHECK_EQ(points.samples_m[1].z, 3e-3f);
  CHECK_EQ(points.samples_m[2].x, 4.0f);
  CHECK_EQ(points.rows[2], 2u);
  CHECK_EQ(points.notes.size(), 0u);
}

TEST(Csv_CrLfBlankLinesQuotesSpacesAndNoLastNewline_AreAccepted) {
  const CurvePoints points = read("\xEF\xBB\xBF\"x\", y ,z\r\n\r\n 0, 0 ,0\r\n1,2,3");
  CHECK(points.problem.empty());
  CHECK_EQ(points.samples_m.size(), 2u);
  CHECK_EQ(points.samples_m[1].z, 3.0f);
}

TEST(ColumnsAreFoundByNameAndOthersPassedOver) {
  const CurvePoints points = read("t,z,y,x\n0,1,2,3\n1,4,5,6\n");
  CHECK(points.problem.empty());
  CHECK_EQ(points.samples_m[0].x, 3.0f);
  CHECK_EQ(points.samples_m[0].z, 1.0f);
  CHECK_EQ(points.notes.size(), 1u);
  CHECK(has(points.notes[0], "'t'"));
}

TEST(UnitsAreAppliedInDoubleAndRoundedOnce) {
  const CurvePoints points = read("x,y,z\n0,0,0\n0.1,25.4,1234.567\n", 0.001);
  CHECK_EQ(points.samples_m[1].x, static_cast<float>(0.1 * 0.001));
  CHECK_EQ(points.samples_m[1].z, static_cast<float>(1234.567 * 0.001));
}

TEST(TheLocaleOfTheMachineChangesNothing) {
  const char* tried[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "C"};
  for (const char* name : tried) {
    std::setlocale(LC_ALL, name);
    CHECK_EQ(read("x,y,z\n0,0,0\n1.5,2,3\n").samples_m[1].x, 1.5f);
  }
  std::setlocale(LC_ALL, "C");
}

TEST(RepeatedSamplesAreDroppedAndReported) {
  const CurvePoints points = read("x,y,z\n0,0,0\n0,0,0\n1,0,0\n1,0,1e-14\n1,0,0\n2,0,0\n");
  CHECK(points.problem.empty());
  CHECK_EQ(points.samples_m.size(), 3u);
  CHECK_EQ(points.rows[1], 2u);
  CHECK_EQ(points.rows[2], 5u);
  CHECK_EQ(points.notes.size(), 1u);
  CHECK(has(points.notes[0], "dropped 3 samples"));
  CHECK(has(points.notes[0], "line 3"));
}

TEST(AClosedCurveKeepsItsLastSample) {
  CHECK_EQ(read("x,y,z\n0,0,0\n1,0,0\n1,1,0\n0,0,0\n").samples_m.size(), 4u);
}

TEST(TooFewSamplesAreRefused) {
  CHECK(refused("x,y,z\n1,2,3\n", {"only one sample", "at least two"}));
  CHECK(refused("x,y,z\n", {"no samples", "at least two"}));
  CHECK(refused("", {"is empty", "x,y,z"}));
  CHECK(refused("\n\n", {"is empty", "x,y,z"}));
}

TEST(ACurveWithoutLengthIsRefused) {
  CHECK(refused("x,y,z\n1,2,3\n1,2,3\n1,2,3\n", {"all 3 samples", "no length"}));
  CHECK(refused("x,y,z\n0,0,0\n1e-9,0,0\n", {"smaller than a thousandth", "--unit"}));
}

TEST(WhatIsNotAFiniteNumberIsRefusedWithItsLine) {
  CHECK(refused("x,y,z\n0,0,0\n1,nan,0\n2,0,0\n", {"line 3", "y = 'nan'", "mend or delete"}));
  CHECK(refused("x,y,z\n0,0,0\ninf,0,0\n", {"line 3", "x = 'inf'"}));
  CHECK(refused("x,y,z\n0,0,0\n1,0,1e39\n", {"line 3", "z = '1e39'", "too large"}));
  CHECK(refused("x,y,z\n0,0,0\n1,0,1e999\n", {"line 3", "too large"}));
  CHECK(refused("x,y,z\n0,0,0\n1,,0\n", {"line 3", "y = ''"}));
  CHECK(refused("x,y,z\n0,0,0\n1,0x1p3,0\n", {"line 3", "y = '0x1p3'"}));
  CHECK(refused("x,y,z\n0,0,0\n2e9,0,0\n", {"line 3", "1e9 m", "--unit"}));
}

TEST(AMissingHeaderIsRefused) {
  CHECK(refused("0,0,0,0\n1,0,0,0\n", {"line 1", "no header", "4 columns", "x,y,z"}));
  CHECK(refused("a,b,c\n0,0,0\n1,0,0\n", {"line 1", "'a,b,c'", "x,y,z"}));
  CHECK(refused("x,y\n0,0\n1,0\n", {"line 1", "x,y,z"}));
  CHECK(refused("x,y,z,x\n0,0,0,0\n1,0,0,0\n", {"line 1", "once"}));
}

TEST(OtherSeparators_AreTaken_MixedOnesRefused) {
  for (const char* text :
       {"x;y;z\n0;0;0\n1.5;0;2\n", "x\ty\tz\n0\t0\t0\n1.5\t0\t2\n", "x y z\n0 0 0\n1.5  0 2\n",
        "sep=;\nx;y;z\n0;0;0\n1.5;0;2\n", "\"X\",\"Y\",\"Z\"\r\n0,0,0\r\n\"1.5\",0,2\r\n",
        "# x y z\n0 0 0\n1.5 0 2\n", "0.0e+00 0 0\n1.5 0 2\n", ",x,y,z\n0,0,0,0\n1,1.5,0,2\n",
        "# from a probe\nx,y,z\n0,0,0\n# half way\n1.5,0,2\n"}) {
    const CurvePoints points = read(text);
    CHECK(points.problem.empty());
    CHECK_EQ(points.samples_m.size(), 2u);
    if (points.samples_m.size() != 2) continue;
    CHECK_EQ(points.samples_m[1].x, 1.5f);
    CHECK_EQ(points.samples_m[1].z, 2.0f);
  }
  CHECK(refused("x,y,z\n0;0;0\n", {"line 2", "semicolons"}));
  CHECK(refused("x,y,z\n0,0,0,0,1,5\n", {"line 2", "6 fields", "point, not a comma"}));
  CHECK(refused("x;y;z\n0;0;0\n1,5;0;0\n", {"line 3", "--decimal-comma"}));
  CHECK(refused(std::string("\xFF\xFEx\0,\0y", 8), {"UTF-16", "UTF-8"}));
}

TEST(DecimalCommas_AreTakenByOption) {
  const CurvePoints points =
      read_curve_csv_bytes("x;y;z\n0;0;0\n1,5;-0,25;2\n", "path.csv", 1.0, {true});
  CHECK(points.problem.empty());
  CHECK_EQ(points.samples_m[1].x, 1.5f);
  CHECK_EQ(points.samples_m[1].y, -0.25f);
}

TEST(UnitsInTheHeader_CountUnlessOneIsGiven) {
  firmtouch::tools::FileFrame own;
  own.has_unit = false;
  for (const char* header :
       {"x (mm),y (mm),z (mm)", "x_mm,y_mm,z_mm", "X [mm],Y [mm],Z [mm]", "x/mm,y/mm,z/mm"}) {
    const std::string text = std::string(header) + "\n0,0,0\n10,0,20\n";
    CHECK_EQ(read_curve_csv_bytes(text, "path.csv", own).samples_m[1].z,
             static_cast<float>(20 * 0.001));
    CHECK_EQ(read(text).samples_m[1].z, 20.0f);
  }
  CHECK(has(read_curve_csv_bytes("x_mm,y_m,z_mm\n0,0,0\n1,1,1\n", "path.csv", own).problem,
            "different units"));
}

TEST(RowsOfAnotherLengthAreRefusedWithTheirLine) {
  CHECK(refused("x,y,z\n0,0,0\n1,2\n", {"line 3", "2 fields", "header names 3"}));
  CHECK(refused("x,y,z\n0,0,0\n1,2,3,\n", {"line 3", "4 fields", "mend or delete"}));
}

TEST(AFileThatCannotBeOpenedIsNamed) {
  const CurvePoints points = firmtouch::tools::read_curve_csv("no/such/path.csv", 1.0);
  CHECK(has(points.problem, "no/such/path.csv"));
  CHECK(has(points.problem, "cannot be opened"));
}

// sin 2 pi is -2.4e-16 in double: the ring's last row is 7e-18 m beside its first.
TEST(RingThatClosesWithinRounding_IsClosedAndSaidSo) {
  const CurvePoints ring = read("x,y,z\n0.03,0,0\n0,0.03,0\n-0.03,0,0\n0,-0.03,0\n0.03,-7e-18,0\n");
  CHECK(ring.problem.empty());
  CHECK_EQ(ring.samples_m.size(), 5u);
  CHECK_EQ(ring.samples_m[4].y, 0.0f);
  CHECK_EQ(ring.notes.size(), 1u);
  CHECK(!ring.notes.empty() &&
        has(ring.notes[0], "closed: the last row is 7e-18 m from the first"));
  // Beyond the rounding of 0.03 m, 3.6e-9 m, it stays open.
  const CurvePoints open = read("x,y,z\n0.03,0,0\n0,0.03,0\n-0.03,0,0\n0,-0.03,0\n0.03,-1e-8,0\n");
  CHECK_EQ(open.samples_m[4].y, -1e-8f);
  CHECK_EQ(open.notes.size(), 0u);
}

TEST(DamagedModel_Csv_EndsInAProblemOrACurve) {
  const std::string good[] = {
      "x,y,z\n0,0,0\n1,-2.5,3e-3\n+4,5,6\n7,8,9\n",
      "# t\n\"X (mm)\";\"Y (mm)\";\"Z (mm)\"\r\n0;1;2\r\n3;4;5\r\n6;6;6\r\n",
      "0 0 0\n1 0 0\n1 1 0\n"};
  firmtouch::test::attack({good[0], good[1], good[2]}, [](const std::string& bytes) {
    const CurvePoints points = read(bytes);
    if (!points.problem.empty()) CHECK(has(points.problem, "path.csv"));
    if (points.problem.empty()) CHECK(points.samples_m.size() >= 2);
    CHECK_EQ(points.samples_m.size(), points.rows.size());
  });
}
