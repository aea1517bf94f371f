#include "chart_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "chart_panel.h"

namespace plume::command {
namespace {

constexpr const char *kGray = "#555555", *kPlanner = "#d01c1f";
constexpr std::array kKindColors{"#1f5fa8", "#63b0e8", "#e08214", "#2a9d4a",
                                 "#8e44ad", "#444444", "#c9a000"};
constexpr std::array kPeerColors{"#8c510a", "#c51b7d", "#01665e", "#7b8a00",
                                 "#5e3c99", "#b2182b", "#35978f", "#bf812d"};
// Gnuplot's numbers of filled shapes by order, and of crosses and stars for peers.
constexpr std::array kOrderShapes{7, 7, 9, 5, 13};
constexpr std::array kPeerShapes{2, 1, 3, 12, 8, 10, 4, 14};
constexpr std::array kOrderNames{"", "order 1", "order 2", "order 3", "adaptive order"};
// Of the fonts' letters, pixels per point of size; what labels are made room for.
constexpr double kLetter = 0.78, kLine = 1.62;

std::string quote(const std::string& text) {
  std::string made = "'";
  for (const char c : text) {
    if (c == '\'') made += '\'';
    made += static_cast<unsigned char>(c) < 32 ? ' ' : c;
  }
  return made + "'";
}

double width_of(const std::string& text, double size) {
  return kLetter * size * static_cast<double>(text.size());
}

// A point's label where its name is shown.
std::string shown_name(const ChartWay& way) {
  return way.tolerance ? way.name.substr(0, way.name.find(':')) : way.name;
}

class Script {
 public:
  explicit Script(const Chart& chart)
      : chart_(chart),
        all_(everything(chart)),
        main_({95, 105, 935, 815}, all_, &ChartPoint::max_error),
        rms_({1140, 105, 620, 230}, all_, &ChartPoint::rms_error) {
    for (const std::size_t i : chart.front)
      main_.make_room(chart.points[i].milliseconds,
                      width_of(front_label(i), kFrontSize) + kGap + 10);
    rms_.share_times(main_);
  }

  std::string make(const std::string& picture, bool svg) {
    text_ = fmt::format(
        "set terminal {} size {:g},{:g} font 'Sans,10' {} noenhanced\nset output '{}'\n",
        svg ? "svg" : "pngcairo", kChartWidth, kChartHeight, svg ? "background 'white'" : "",
        picture);
    text_ +=
        "set multiplot\nset logscale xy\nset grid xtics ytics lc rgb '#d8d8d8' lw 1\n"
        "set border lc rgb '#888888'\nset tics textcolor rgb '#333333' scale 0.5\nunset key\n";
    heading();
    front_labels();
    tolerance_lines();
    numbers();
    legend();
    list();
    panel(main_, &ChartPoint::max_error,
          "greatest error of a channel (linear RGBA, against the reference)", 1.0);
    text_ += "unset label\nunset arrow\n";
    panel(rms_, &ChartPoint::rms_error, "RMS error, the same points", 0.7);
    text_ += "unset multiplot\n";
    return text_;
  }

 private:
  static constexpr double kFrontSize = 9, kNumberSize = 7.5, kGap = 11;

  static std::vector<ChartPoint> everything(const Chart& chart) {
    std::vector<ChartPoint> all = chart.points;
    for (const PeerFamily& family : chart.peers)
      all.insert(all.end(), family.points.begin(), family.points.end());
    return all;
  }

  std::string front_label(std::size_t i) const {
    return fmt::format("{}  {}", shown_name(chart_.ways[i].way), i + 1);
  }

  void label(double x, double y, const std::string& text, double size, const std::string& color,
             const std::string& more = "left") {
    text_ +=
        fmt::format("set label {} at screen {:.5f},{:.5f} {} font 'Sans,{:g}' tc rgb '{}' front\n",
                    quote(text), x / kChartWidth, 1 - y / kChartHeight, more, size, color);
  }
  void line(ChartPlace a, ChartPlace b, const std::string& style) {
    text_ += fmt::format("set arrow from screen {:.5f},{:.5f} to screen {:.5f},{:.5f} nohead {}\n",
                         a.x / kChartWidth, 1 - a.y / kChartHeight, b.x / kChartWidth,
                         1 - b.y / kChartHeight, style);
  }
  void mark(double x, double y, int shape, double size, const std::string& color,
            const std::string& text) {
    text_ += fmt::format(
        "set label {} at screen {:.5f},{:.5f} left offset 1.2,0 point pt {} ps {} lc rgb '{}' "
        "lw 1.5 font 'Sans,9' tc rgb '#333333'\n",
        quote(text), x / kChartWidth, 1 - y / kChartHeight, shape, size, color);
  }

  void heading() {
    label(40, 28, chart_.subject.mesh + ": error against time", 15, "#111111");
    label(40, 56, describe(chart_.subject), 10, kGray);
  }

  std::string color_of(std::size_t way) const {
    return kKindColors[static_cast<std::size_t>(chart_.ways[way].way.kind)];
  }
  int shape_of(std::size_t way) const {
    if (!curved()) return kOrderShapes[1];
    return kOrderShapes[static_cast<std::size_t>(chart_.ways[way].way.settings.order)];
  }
  // Whether the chart has more than one order.
  bool curved() const {
    return std::any_of(chart_.ways.begin(), chart_.ways.end(), [&](const MeasuredWay& way) {
      return way.way.settings.order == ScalarOrder::quadratic;
    });
  }
  bool on_front(std::size_t way) const {
    return std::find(chart_.front.begin(), chart_.front.end(), way) != chart_.front.end();
  }

  void front_labels() {
    std::vector<ChartPlace> places;
    std::vector<double> widths;
    for (const std::size_t i : chart_.front) {
      places.push_back(main_.place(chart_.points[i]));
      widths.push_back(width_of(front_label(i), kFrontSize));
    }
    const auto boxes = front_label_places(places, widths, kLine * kFrontSize, kGap);
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      const std::size_t i = chart_.front[k];
      const double y = boxes[k].top + boxes[k].height / 2, x = boxes[k].left + boxes[k].width;
      label(x, y, front_label(i), kFrontSize, chart_.ways[i].way.tolerance ? kPlanner : color_of(i),
            "right");
      if (y - places[k].y > 4) line({x + 2, y}, places[k], "lc rgb '#bbbbbb' lw 0.7 back");
      taken_.push_back(boxes[k]);
    }
  }

  // What was asked of the planner, from the left edge to what it chose.
  void tolerance_lines() {
    for (std::size_t i = 0; i < chart_.ways.size(); ++i) {
      if (!chart_.ways[i].way.tolerance) continue;
      const ChartPlace at =
          main_.place(chart_.points[i].milliseconds, *chart_.ways[i].way.tolerance);
      line(at, main_.place(chart_.points[i]), fmt::format("lc rgb '{}' lw 1 dt 3 back", kPlanner));
      line({at.x - 7, at.y}, {at.x + 7, at.y}, fmt::format("lc rgb '{}' lw 2 back", kPlanner));
    }
  }

  // Of all that have no name beside them: the planner's choices first, then numbers.
  void numbers() {
    for (const ChartPoint& point : all_) {
      const ChartPlace at = main_.place(point);
      taken_.push_back({at.x - 5, at.y - 5, 10, 10});
    }
    // The front's steps: to the right, then down.
    for (std::size_t k = 0; k + 1 < chart_.front.size(); ++k) {
      const ChartPlace a = main_.place(chart_.points[chart_.front[k]]);
      const ChartPlace b = main_.place(chart_.points[chart_.front[k + 1]]);
      taken_.push_back({a.x, a.y - 1, b.x - a.x, 2});
      taken_.push_back({b.x - 1, a.y, 2, b.y - a.y});
    }
    std::vector<ChartPlace> places;
    std::vector<double> widths;
    std::vector<std::string> texts, colors;
    const auto add = [&](std::size_t number, const std::string& text, const std::string& color) {
      places.push_back(main_.place(all_[number]));
      texts.push_back(text);
      widths.push_back(width_of(text, kNumberSize));
      colors.push_back(color);
    };
    for (std::size_t i = 0; i < chart_.ways.size(); ++i)
      if (chart_.ways[i].way.tolerance && !on_front(i)) add(i, front_label(i), kPlanner);
    for (std::size_t i = 0; i < chart_.ways.size(); ++i)
      if (!chart_.ways[i].way.tolerance && !on_front(i)) add(i, std::to_string(i + 1), color_of(i));
    std::size_t number = chart_.ways.size();
    for (std::size_t family = 0; family < chart_.peers.size(); ++family)
      for (std::size_t k = 0; k < chart_.peers[family].points.size(); ++k, ++number)
        add(number, std::to_string(number + 1), peer_color(family));
    const auto boxes = label_places(places, widths, kLine * kNumberSize, 6, main_.area(), taken_);
    for (std::size_t k = 0; k < boxes.size(); ++k)
      label(boxes[k].left + boxes[k].width / 2, boxes[k].top + boxes[k].height / 2, texts[k],
            kNumberSize, colors[k], "center");
  }

  static std::string peer_color(std::size_t family) {
    return kPeerColors[family % kPeerColors.size()];
  }
  static int peer_shape(std::size_t family) { return kPeerShapes[family % kPeerShapes.size()]; }

  void legend() {
    double y = 400;
    int column = 0;
    const auto entry = [&](int shape, double size, const std::string& color,
                           const std::string& text) {
      mark(1105 + 340 * column, y, shape, size, color, text);
      if (++column == 2) {
        column = 0;
        y += 19;
      }
    };
    for (std::size_t kind = 0; kind < kKindColors.size(); ++kind)
      if (std::any_of(chart_.ways.begin(), chart_.ways.end(), [&](const MeasuredWay& way) {
            return static_cast<std::size_t>(way.way.kind) == kind;
          }))
        entry(7, 1.3, kKindColors[kind], name_of(static_cast<WayKind>(kind)));
    if (curved())
      for (std::size_t order = 1; order < kOrderShapes.size(); ++order)
        entry(kOrderShapes[order], 1.3, "#999999", kOrderNames[order]);
    entry(6, 2.2, kPlanner, "chosen for a tolerance, and what was asked");
    for (std::size_t family = 0; family < chart_.peers.size(); ++family)
      entry(peer_shape(family), 1.3, peer_color(family), chart_.peers[family].name);
    legend_end_ = y + (column > 0 ? 19 : 0);
  }

  struct Row {
    std::string text, color;
    bool strong;
  };

  std::vector<Row> rows() const {
    std::vector<Row> rows;
    for (std::size_t i = 0; i < chart_.ways.size(); ++i) {
      const auto& by = chart_.dominators[i];
      rows.push_back({fmt::format("{}  {}{}", i + 1, chart_.points[i].method,
                                  by ? fmt::format("  ({})", *by + 1) : ""),
                      chart_.ways[i].way.tolerance ? kPlanner : color_of(i), !by});
    }
    for (std::size_t family = 0; family < chart_.peers.size(); ++family)
      for (const ChartPoint& point : chart_.peers[family].points)
        rows.push_back(
            {fmt::format("{}  {}", rows.size() + 1, point.method), peer_color(family), false});
    return rows;
  }

  // What the numbers stand for, in two columns, as small as it takes.
  void list() {
    constexpr double kLeft = 1097, kColumn = 348;
    label(kLeft, legend_end_ + 10,
          "numbers by time; in brackets the one that takes its place, as exact and faster", 8,
          kGray);
    const std::vector<Row> listed = rows();
    const double top = legend_end_ + 34, bottom = kChartHeight - 14;
    const std::size_t half = (listed.size() + 1) / 2;
    const double step = std::min(15.0, (bottom - top) / static_cast<double>(half));
    double size = std::min(8.0, step / kLine);
    for (const Row& row : listed) size = std::min(size, kColumn / width_of(row.text, 1));
    for (std::size_t i = 0; i < listed.size(); ++i) {
      const double x = kLeft + (i < half ? 0 : kColumn);
      const double y = top + step * static_cast<double>(i % half);
      text_ += fmt::format(
          "set label {} at screen {:.5f},{:.5f} left font 'Sans{},{:.2f}' tc rgb '{}'\n",
          quote(listed[i].text), x / kChartWidth, 1 - y / kChartHeight,
          listed[i].strong ? " Bold" : "", size, listed[i].color);
    }
  }

  // The stepped line under which nothing is, out to the panel's edges.
  std::string steps(const ChartPanel& panel, const std::vector<ChartPoint>& points,
                    ErrorOf error) const {
    std::string data;
    const auto front = pareto_front(points, error);
    double before = 1e9;  // above all
    for (const std::size_t i : front) {
      data += fmt::format("{} {}\n", points[i].milliseconds, before);
      before = panel.drawn(points[i].*error);
      data += fmt::format("{} {}\n", points[i].milliseconds, before);
    }
    return data + fmt::format("1e12 {}\ne\n", before);
  }

  void panel(const ChartPanel& panel, ErrorOf error, const std::string& title, double scale) {
    text_ += panel.axes(title, true);
    std::vector<std::string> plots, data;
    const auto add = [&](const std::string& style, const std::string& lines) {
      plots.push_back("'-' using 1:2 with " + style);
      data.push_back(lines);
    };
    add("lines lc rgb '#222222' lw 1.6", steps(panel, chart_.points, error));
    for (std::size_t family = 0; family < chart_.peers.size(); ++family)
      add(fmt::format("lines lc rgb '{}' lw 1 dt 2", peer_color(family)),
          steps(panel, chart_.peers[family].points, error));
    const auto dot = [&](const ChartPoint& point) {
      return fmt::format("{} {}\n", point.milliseconds, panel.drawn(point.*error));
    };
    std::map<std::string, std::string> by_style;
    for (std::size_t i = 0; i < chart_.ways.size(); ++i) {
      by_style[fmt::format("points pt {} ps {} lc rgb '{}'", shape_of(i),
                           scale * (on_front(i) ? 1.5 : 1.0), color_of(i))] +=
          dot(chart_.points[i]);
      if (chart_.ways[i].way.tolerance)
        by_style[fmt::format("points pt 6 ps {} lw 2 lc rgb '{}'", scale * 2.4, kPlanner)] +=
            dot(chart_.points[i]);
    }
    for (std::size_t family = 0; family < chart_.peers.size(); ++family)
      for (const ChartPoint& point : chart_.peers[family].points)
        by_style[fmt::format("points pt {} ps {} lw 1.5 lc rgb '{}'", peer_shape(family),
                             scale * 1.2, peer_color(family))] += dot(point);
    for (const auto& [style, lines] : by_style) add(style, lines + "e\n");
    text_ += fmt::format("plot {}\n", fmt::join(plots, ", \\\n  "));
    for (const std::string& lines : data) text_ += lines;
  }

  const Chart& chart_;
  const std::vector<ChartPoint> all_;  // ours, then the peers'
  ChartPanel main_, rms_;
  std::vector<LabelBox> taken_;
  double legend_end_ = 0;
  std::string text_;
};

}  // namespace

std::string chart_script(const Chart& chart, const std::string& picture, bool svg) {
  return Script(chart).make(picture, svg);
}

}  // namespace plume::command
