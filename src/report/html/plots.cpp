// Plots as SVG: one small one per panel, every figure with its interval.
#include <fmt/format.h>

#include <algorithm>

#include "options/options.h"
#include "report/html/markup.h"
#include "report/html/plot_data.h"
#include "report/html/sections.h"
#include "report/number_text.h"

namespace boxwood::html {
namespace {

// Of one panel, in the units of its view box.
constexpr double width = 440, height = 270, left = 56, right = 12, top = 10, bottom = 44;
constexpr std::size_t hues = 8;  // as many as the style sheet has
constexpr std::size_t most_x_labels = 12;

class Panel {
 public:
  Panel(const PlotData& data, const Levels& panel) : data_(data), panel_(panel), y_(data.y_axis(panel)) {
    if (by_number()) x_ = axis_over(*number(data.xs.front()), *number(data.xs.back()), false);
  }

  std::string svg() const {
    std::string out = fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\">", width, height);
    out += grid() + x_labels() + titles();
    for (std::size_t i = 0; i < data_.series.size(); ++i) out += series(i);
    return out + "</svg>";
  }

 private:
  bool by_number() const { return data_.spec.kind == "scatter" && data_.numbers; }
  bool bars() const { return data_.spec.kind == "bar"; }

  double y(double value) const { return top + (1 - y_.at(value)) * (height - top - bottom); }
  double slot() const { return (width - left - right) / static_cast<double>(data_.xs.size()); }
  /// The middle of the place of the i-th level.
  double x(std::size_t i) const {
    if (by_number()) return left + x_.at(*number(data_.xs[i])) * (width - left - right);
    return left + (static_cast<double>(i) + 0.5) * slot();
  }
  /// Series beside each other, so that no interval hides another.
  double x(const Cell& cell, std::size_t series) const {
    const double offset = (static_cast<double>(series) + 0.5) / static_cast<double>(data_.series.size()) - 0.5;
    const double spread = bars() ? 0.8 * slot() : by_number() ? 0 : std::min(0.5 * slot(), 30.0);
    return x(data_.x_of(cell)) + offset * spread;
  }

  std::string line(const char* kind, double x1, double y1, double x2, double y2) const {
    return fmt::format("<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>", kind, x1, y1, x2,
                       y2);
  }

  std::string grid() const {
    std::string out;
    for (const double tick : y_.ticks) {
      out += line("grid", left, y(tick), width - right, y(tick));
      out += fmt::format("<text class=\"end\" x=\"{}\" y=\"{:.1f}\">{}</text>", left - 6, y(tick) + 4, tick_text(tick));
    }
    if (data_.ratio) out += line("one", left, y(1), width - right, y(1));
    return out + line("axis", left, height - bottom, width - right, height - bottom);
  }

  static std::string tick_text(double tick) {
    const double size = std::abs(tick);
    if (size >= 1e9) return fmt::format("{:.3g} G", tick / 1e9);
    if (size >= 1e6) return fmt::format("{:.3g} M", tick / 1e6);
    if (size >= 1e4) return fmt::format("{:.3g} k", tick / 1e3);
    return fmt::format("{:.4g}", size < 1e-12 ? 0.0 : tick);
  }

  std::string x_labels() const {
    const std::size_t every = (data_.xs.size() + most_x_labels - 1) / most_x_labels;
    // About six units a letter; what does not fit into its place is cut, and whole in the tooltip.
    const auto fits = static_cast<std::size_t>(std::max(3.0, slot() * static_cast<double>(every) / 6.5));
    std::string out;
    for (std::size_t i = 0; i < data_.xs.size(); i += every) {
      const std::string& name = data_.xs[i];
      const std::string shown = name.size() > fits ? name.substr(0, fits - 1) + "…" : name;
      out += fmt::format("<text class=\"middle\" x=\"{:.1f}\" y=\"{}\">{}<title>{}</title></text>", x(i),
                         height - bottom + 16, escaped(shown), escaped(name));
    }
    return out;
  }

  std::string titles() const {
    const PlotSpec& spec = data_.spec;
    return fmt::format("<text class=\"middle title\" x=\"{}\" y=\"{}\">{}</text>", (left + width - right) / 2,
                       height - 8, escaped(spec.x));
  }

  std::string series(std::size_t index) const {
    const std::vector<const Cell*> cells = data_.cells_of(panel_, data_.series[index]);
    if (cells.empty()) return "";
    std::string marks, path;
    for (const Cell* cell : cells) {
      const double cx = x(*cell, index), cy = y(cell->estimate.median);
      path += fmt::format("{}{:.1f},{:.1f}", path.empty() ? "" : " ", cx, cy);
      marks += mark(*cell, index, cx, cy);
    }
    const bool joined = data_.spec.kind == "line" && cells.size() > 1;
    return fmt::format("<g class=\"series hue{}{}\" data-series=\"{}\">{}{}</g>", index % hues,
                       index / hues % 2 ? " dashed" : "", index,
                       joined ? fmt::format("<polyline points=\"{}\"/>", path) : "", marks);
  }

  std::string mark(const Cell& cell, std::size_t index, double cx, double cy) const {
    const Estimate& e = cell.estimate;
    std::string out = "<g>";
    if (bars()) {
      const double wide = 0.8 * slot() / static_cast<double>(data_.series.size());
      const double base = y(data_.ratio ? 1 : 0);
      out += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>", cx - wide / 2 * 0.92,
                         std::min(cy, base), wide * 0.92, std::abs(base - cy));
    } else {
      out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.2\"/>", cx, cy);
    }
    if (e.high > e.low) {
      for (const double end : {e.low, e.high}) out += line("whisker", cx - 3, y(end), cx + 3, y(end));
      out += line("whisker", cx, y(e.low), cx, y(e.high));
    }
    const std::string name = option_text::join(data_.series[index], " · ");
    return out + fmt::format("<title>{}{}{} {}: {}</title></g>", escaped(name), name.empty() ? "" : "; ",
                             escaped(data_.spec.x), escaped(cell.factors.at(data_.spec.x)), escaped(cell_text(cell)));
  }

  const PlotData& data_;
  const Levels& panel_;
  Axis y_, x_;
};

std::string legend(const PlotData& data) {
  if (data.series.size() < 2) return "";
  std::string out =
      fmt::format("<p class=\"legend\"><span>{}</span>", escaped(option_text::join(data.spec.series, " · ")));
  for (std::size_t i = 0; i < data.series.size(); ++i) {
    out += fmt::format("<button type=\"button\" data-series=\"{}\"><i class=\"hue{}{}\"></i>{}</button>", i, i % hues,
                       i / hues % 2 ? " dashed" : "", escaped(option_text::join(data.series[i], " · ")));
  }
  return out + "</p>\n";
}

std::string plot_html(const PlotResult& result, const std::string& prefix) {
  const PlotSpec& spec = result.spec;
  const PlotData data(result);
  std::string out = fmt::format(
      "<figure class=\"plot\" id=\"{}-plot-{}\"><figcaption><h3>{}</h3><p>{}{}</p></figcaption>\n{}<div "
      "class=\"panels\">\n",
      prefix, escaped(spec.id), escaped(spec.title.empty() ? spec.id : spec.title),
      spec.y_title.empty() ? "" : escaped(spec.y_title) + ": ", figure_note(spec.figure), legend(data));
  for (const Levels& panel : data.panels) {
    out +=
        fmt::format("<div><h4>{}</h4>{}</div>\n", escaped(option_text::join(panel, " · ")), Panel(data, panel).svg());
  }
  return out + "</div></figure>\n";
}

}  // namespace

std::string plots_section(const StudyResult& result, const std::string& prefix) {
  std::string out;
  for (const PlotResult& plot : result.plots) {
    if (!plot.cells.empty()) out += plot_html(plot, prefix);
  }
  return out.empty() ? out : fmt::format("<section id=\"{}-plots\"><h2>Plots</h2>\n{}</section>\n", prefix, out);
}

}  // namespace boxwood::html
