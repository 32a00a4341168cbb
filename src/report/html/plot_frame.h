#pragma once
#include <cstddef>
#include <string>

#include "report/html/axis.h"

// What all plots are drawn in: one panel, in the units of its view box, as SVG.
namespace boxwood::html {

inline constexpr double plot_width = 440, plot_height = 270;
inline constexpr double plot_left = 56, plot_right = 12, plot_top = 10, plot_bottom = 44;
inline constexpr std::size_t hues = 8;  ///< as many as the style sheet has

/// Horizontal lines at round values.
struct PlotFrame {
  Axis y;

  double at(double value) const { return plot_top + (1 - y.at(value)) * (plot_height - plot_top - plot_bottom); }
  std::string grid() const;
};

/// Where a value of a horizontal axis lies.
double plot_x(const Axis& axis, double value);
/// Round values under the horizontal axis, with lines.
std::string x_grid(const Axis& axis);
/// The name of the horizontal axis.
std::string plot_title(const std::string& text);

std::string svg_panel(const std::string& content);
std::string svg_line(const char* kind, double x1, double y1, double x2, double y2);
/// An interval from y1 to y2, or from x1 to x2.
std::string upright_whisker(double x, double y1, double y2);
std::string level_whisker(double y, double x1, double x2);

}  // namespace boxwood::html
