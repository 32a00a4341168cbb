#include "report/html/scatter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "options/options.h"
#include "report/html/markup.h"
#include "report/html/plot_frame.h"
#include "report/number_text.h"

namespace boxwood::html {
namespace {

struct Point {
  const Cell* cell;
  Estimate x;
  bool on_front;
  std::size_t series;
};

std::vector<Point> points_of(const PlotResult& plot, const std::vector<Levels>& series, const Levels& panel) {
  std::vector<Point> out;
  for (std::size_t i = 0; i < plot.cells.size(); ++i) {
    const Cell& cell = plot.cells[i];
    if (levels(cell, plot.spec.panels) != panel || !std::isfinite(plot.x[i].median)) continue;
    const auto which = std::ranges::find(series, levels(cell, plot.spec.series)) - series.begin();
    out.push_back({&cell, plot.x[i], i < plot.on_front.size() && plot.on_front[i], static_cast<std::size_t>(which)});
  }
  std::ranges::stable_sort(out, {}, [](const Point& point) { return point.x.median; });
  return out;
}

Axis axis_of(const std::vector<Point>& points, bool logarithmic, const Estimate& (*of)(const Point&)) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Point& point : points) {
    for (const double value : {of(point).low, of(point).median, of(point).high}) {
      if (!std::isfinite(value) || (logarithmic && !(value > 0))) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (low > high) low = high = 1;
  return axis_over(logarithmic ? low : std::min(low, 0.0), high, logarithmic);
}

std::string estimate_text(const Estimate& e) { return e.high > e.low ? with_interval(e) : significant(e.median); }

/// The place of a name beside its point, inside the panel.
std::string name_tag(double x, double y, const std::string& name) {
  const bool to_the_left = x > (plot_left + plot_width) / 2;
  return fmt::format("<text class=\"name{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", to_the_left ? " end" : "",
                     x + (to_the_left ? -7 : 7), y - 5, escaped(name));
}

}  // namespace

std::string scatter_panel(const PlotResult& plot, const std::vector<Levels>& series, const Levels& panel) {
  const PlotSpec& spec = plot.spec;
  const std::vector<Point> points = points_of(plot, series, panel);
  const Axis x = axis_of(points, spec.log_x, [](const Point& p) -> const Estimate& { return p.x; });
  const PlotFrame frame{
      axis_of(points, spec.log_y, [](const Point& p) -> const Estimate& { return p.cell->estimate; })};
  std::string marks, front;
  for (const Point& point : points) {
    const Estimate& e = point.cell->estimate;
    const double cx = plot_x(x, point.x.median), cy = frame.at(e.median);
    const std::string name = option_text::join(series[point.series], " · ");
    if (point.on_front) front += fmt::format("{}{:.1f},{:.1f}", front.empty() ? "" : " ", cx, cy);
    marks += fmt::format("<g class=\"series hue{}{}\" data-series=\"{}\"><g>", point.series % hues,
                         point.series / hues % 2 ? " dashed" : "", point.series);
    if (e.high > e.low) marks += upright_whisker(cx, frame.at(e.low), frame.at(e.high));
    if (point.x.high > point.x.low) marks += level_whisker(cy, plot_x(x, point.x.low), plot_x(x, point.x.high));
    marks += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.2\"/>", cx, cy);
    if (point.on_front) {
      marks += fmt::format("<circle class=\"ring\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"6\"/>", cx, cy);
      marks += name_tag(cx, cy, name);
    }
    marks += fmt::format("<title>{}; {}: {}; {}: {}</title></g></g>", escaped(name), escaped(spec.x_title),
                         estimate_text(point.x), escaped(spec.y_title), estimate_text(e));
  }
  if (!front.empty()) front = fmt::format("<polyline class=\"front\" points=\"{}\"/>", front);
  return svg_panel(frame.grid() + x_grid(x) + plot_title(spec.x_title) + front + marks);
}

}  // namespace boxwood::html
