#include "report/html/plot_frame.h"

#include <fmt/format.h>

#include <cmath>

#include "report/html/markup.h"

namespace boxwood::html {
namespace {

constexpr double serif = 3;  // half the length of what ends a whisker

std::string tick_text(double tick) {
  const double size = std::abs(tick);
  if (size >= 1e9) return fmt::format("{:.3g} G", tick / 1e9);
  if (size >= 1e6) return fmt::format("{:.3g} M", tick / 1e6);
  if (size >= 1e4) return fmt::format("{:.3g} k", tick / 1e3);
  return fmt::format("{:.4g}", size < 1e-12 ? 0.0 : tick);
}

}  // namespace

std::string PlotFrame::grid() const {
  std::string out;
  for (const double tick : y.ticks) {
    out += svg_line("grid", plot_left, at(tick), plot_width - plot_right, at(tick));
    out += fmt::format("<text class=\"end\" x=\"{}\" y=\"{:.1f}\">{}</text>", plot_left - 6, at(tick) + 4,
                       tick_text(tick));
  }
  return out +
         svg_line("axis", plot_left, plot_height - plot_bottom, plot_width - plot_right, plot_height - plot_bottom);
}

double plot_x(const Axis& axis, double value) {
  return plot_left + axis.at(value) * (plot_width - plot_left - plot_right);
}

std::string x_grid(const Axis& axis) {
  std::string out;
  for (const double tick : axis.ticks) {
    const double x = plot_x(axis, tick);
    out += svg_line("grid", x, plot_top, x, plot_height - plot_bottom);
    out += fmt::format("<text class=\"middle\" x=\"{:.1f}\" y=\"{}\">{}</text>", x, plot_height - plot_bottom + 16,
                       tick_text(tick));
  }
  return out;
}

std::string plot_title(const std::string& text) {
  return fmt::format("<text class=\"middle title\" x=\"{}\" y=\"{}\">{}</text>",
                     (plot_left + plot_width - plot_right) / 2, plot_height - 8, escaped(text));
}

std::string svg_panel(const std::string& content) {
  return fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\">{}</svg>", plot_width, plot_height, content);
}

std::string svg_line(const char* kind, double x1, double y1, double x2, double y2) {
  return fmt::format("<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>", kind, x1, y1, x2,
                     y2);
}

std::string upright_whisker(double x, double y1, double y2) {
  return svg_line("whisker", x - serif, y1, x + serif, y1) + svg_line("whisker", x - serif, y2, x + serif, y2) +
         svg_line("whisker", x, y1, x, y2);
}

std::string level_whisker(double y, double x1, double x2) {
  return svg_line("whisker", x1, y - serif, x1, y + serif) + svg_line("whisker", x2, y - serif, x2, y + serif) +
         svg_line("whisker", x1, y, x2, y);
}

}  // namespace boxwood::html
