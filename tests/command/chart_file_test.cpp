#include "plume/examples/plume/chart_file.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "plume/examples/plume/chart_report.h"
#include "plume/examples/plume/chart_script.h"
#include "plume/mesh/error.h"
#include "plume/tests/command/chart_points.h"

namespace plume::command {
namespace {

Chart chart_of(const std::vector<ChartPoint>& points, const std::vector<ChartPoint>& others = {}) {
  ChartMeasurement measured;
  for (const ChartPoint& point : points) {
    MeasuredWay way;
    way.way.name = point.method;
    way.point = point;
    measured.ways.push_back(way);
  }
  ChartSubject subject;
  subject.mesh = "it's a \"mesh\", 100% of it.vtu";
  return make_chart(subject, measured, others);
}

RC_GTEST_PROP(ChartFile, CsvIsReadAsItWasWritten, ()) {
  std::vector<ChartPoint> points = tests::any_points();
  for (ChartPoint& point : points) {
    point.milliseconds /= 7;  // no number of few digits
    for (int i = *rc::gen::inRange(0, 4); i > 0; --i)
      point.method += *rc::gen::elementOf(std::string("a,\"\n\r; "));
  }
  const Chart chart = chart_of(points);
  const auto read = parse_chart_csv(chart_csv(chart), "a.csv");
  RC_ASSERT(read.size() == points.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    RC_ASSERT(read[i].method == chart.points[i].method);
    RC_ASSERT(read[i].family == "plume");
    RC_ASSERT(read[i].milliseconds == chart.points[i].milliseconds);
    RC_ASSERT(read[i].max_error == chart.points[i].max_error);
    RC_ASSERT(read[i].rms_error == chart.points[i].rms_error);
  }
}

TEST(ChartFile, ColumnsAreFoundByName) {
  const auto points = parse_chart_csv(
      "rms_error,cells,family,method,max_error,milliseconds\r\n1e-3,9,VTK,\"a, b\",0.5,12\r\n",
      "a.csv");
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].method, "a, b");
  EXPECT_EQ(points[0].family, "VTK");
  EXPECT_EQ(points[0].milliseconds, 12);
  EXPECT_EQ(points[0].max_error, 0.5);
  EXPECT_EQ(points[0].rms_error, 1e-3);
}

std::string complaint(const std::string& text) {
  try {
    parse_chart_csv(text, "peers.csv");
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

TEST(ChartFile, SaysWhatIsWrongWithACsvFileAndWhere) {
  const std::string header = "method,family,milliseconds,max_error,rms_error\n";
  EXPECT_EQ(complaint(header + "\na,b,1,2,3\n"), "none");
  for (const auto& [text, words] : std::vector<std::pair<std::string, std::string>>{
           {"", "peers.csv: empty"},
           {"method,family,ms\n", "peers.csv, line 1: no column 'milliseconds'"},
           {header + "a,b,1,2\n", "peers.csv, line 2: 4 fields instead of 5"},
           {header + "a,b,1,2,3\n\na,b,0,2,3\n",
            "line 4: '0' in the column milliseconds is no pos"},
           {header + "a,b,1,-2,3\n", "'-2' in the column max_error"},
           {header + "a,b,1,nan,3\n", "'nan' in the column max_error"},
           {header + "a,b,1,2,3x\n", "'3x' in the column rms_error"},
           {header + "a,,1,2,3\n", "line 2: no family"},
           {header + "\"a,b,1,2,3\n", "line 2: a quotation mark is not closed"},
           {header + "\"a\"a,b,1,2,3\n", "line 2: text after a closing quotation mark"}})
    EXPECT_NE(complaint(text).find(words), std::string::npos) << complaint(text);
}

TEST(ChartFile, JsonHoldsTheFrontAndThePeers) {
  const Chart chart = chart_of({{"fast", "plume", 1, 1e-2, 1e-3},
                                {"slow", "plume", 2, 1e-2, 1e-3},
                                {"exact", "plume", 3, 0, 0}},
                               {{"theirs", "peer", 6, 1e-2, 1e-3}});
  const auto json = nlohmann::json::parse(chart_json(chart));
  EXPECT_EQ(json["front"], (nlohmann::json{"fast", "exact"}));
  EXPECT_EQ(json["ways"][1]["dominated_by"], "fast");
  EXPECT_TRUE(json["ways"][0]["dominated_by"].is_null());
  EXPECT_EQ(json["peers"][0]["family"], "peer");
  EXPECT_EQ(json["peers"][0]["factors"][1]["factor"], 6);
  EXPECT_TRUE(json["peers"][0]["factors"][2]["factor"].is_null());
}

TEST(ChartFile, TheReportSaysWhatIsDominatedAndByWhat) {
  const std::string report =
      chart_report(chart_of({{"fast", "plume", 1, 1e-2, 1e-3}, {"slow", "plume", 2, 1e-2, 1e-3}},
                            {{"theirs", "peer", 6, 1e-2, 1e-3}}));
  EXPECT_NE(report.find("1: fast (2.0 times as fast)"), std::string::npos) << report;
  EXPECT_NE(report.find("1e-02: 6.0 (theirs); ours 1.0 (fast); 6.00 times as long"),
            std::string::npos)
      << report;
  EXPECT_NE(report.find("1e-03: no point; ours no point"), std::string::npos) << report;
  EXPECT_NE(report.find("all 1 points of others are dominated by ours"), std::string::npos)
      << report;
}

TEST(ChartFile, NamesWithQuotationMarksStayTextForGnuplot) {
  const Chart chart = chart_of({{"a 'quoted' way", "plume", 1, 1e-2, 1e-3}});
  const std::string script = chart_script(chart, "chart.png", false);
  EXPECT_NE(script.find("'it''s a \"mesh\", 100% of it.vtu: error against time'"),
            std::string::npos);
  EXPECT_NE(script.find("a ''quoted'' way"), std::string::npos);
}

}  // namespace
}  // namespace plume::command
