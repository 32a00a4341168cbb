#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "boxwood/vec3.h"
#include "render/whole_paths.h"

namespace boxwood {

// A study as its file says it: what to measure, what to show, what to find out. docs/studies.md describes the file.

/// Names and levels, such as {"method": "median", "k": "4"}. Recipes carry those they were made with; queries also know
/// "scene", "view", "rays" and "recipe".
using Factors = std::map<std::string, std::string>;
/// For each factor the levels that are meant; factors that are not named may have any.
using Where = std::map<std::string, std::vector<std::string>>;

/// Cameras around the mean of the triangles' centroids, or the middle of the scene's box.
struct OrbitSpec {
  std::uint32_t frames = 36;
  double radius = 0;     ///< world units
  double diagonals = 0;  ///< likewise, in diagonals of the scene's box; both 0: just far enough to see all of the scene
  double height = 0;     ///< of the eye above the centre, world units
  std::optional<double> fov;  ///< degrees
};

/// Frames along a smooth curve through key frames, which look from `eyes` to `targets`: one of each per key frame, in
/// shares of the scene's box, so that they fit a stand-in too.
struct PathSpec {
  std::uint32_t frames = 20;
  std::vector<Vec3> eyes, targets;
  float fov = 70;  ///< degrees
};

struct SceneSpec {
  std::string name;
  std::vector<std::string> find;     ///< files and generators; the first that is there is used
  std::vector<std::string> cameras;  ///< names; empty and no orbit: the scene's first
  std::optional<OrbitSpec> orbit;
  std::optional<PathSpec> path;
  std::vector<Vec3> lights;  ///< points in shares of the scene's box, in place of its own lights; empty: its own
  /// Recipes that adapt to rays are built anew for every view whose number is a multiple of this; 0: once, for the
  /// first.
  std::uint32_t rebuild = 0;
  Factors set;  ///< levels that its figures have, above those of the recipe; may name the scene otherwise
  Where only;   ///< recipes that are measured on it; empty: all
};

struct RecipeSpec {
  std::string label;
  std::string text;  ///< placeholders filled in; not yet parsed
  Factors factors;
};

struct RunSpec {
  std::vector<std::string> rays = {"primary"};
  std::uint32_t width = 512, height = 512;
  std::uint32_t bounces = 1;              ///< 1: rays "diffuse"; more: "diffuse1" … "diffuseN"
  float ao_radius = 0;                    ///< world units; 0: a tenth of the scene's diagonal
  std::optional<WholePaths> whole_paths;  ///< none: secondary rays as make_ray_sets() makes them
  std::uint32_t repetitions = 10;         ///< of timings of rays
  std::uint32_t builds = 3;               ///< of timings of builds
  std::uint32_t threads = 1;
  std::uint64_t seed = 1;
  std::uint32_t frames = 0;         ///< views per scene at most, evenly picked; 0: all
  std::vector<std::string> scenes;  ///< names; empty: all
  std::vector<std::string> probes = {"build", "size", "time", "tests", "answers"};
  std::string centre = "median";  ///< or "mean": how repetitions become one figure
};

/// What a table, plot or claim looks at.
struct FigureSpec {
  std::string value;  ///< arithmetic on metrics, such as "build_ms + trace_ms"
  Where where;
  /// Not empty: figures are baseline / this, the baseline being the same but for these levels; unless `value` says
  /// itself what becomes of the baseline, by naming metrics of it.
  Where baseline;
  bool each_view = false;  ///< keep the views of a scene apart instead of taking their mean
};

struct TableSpec {
  std::string id, title;
  FigureSpec figure;
  std::vector<std::string> rows, columns;  ///< factors
  /// Not empty: instead of columns, how the cells that these factors tell apart spread: lowest, mean, highest, number.
  std::vector<std::string> spread;
  std::vector<std::vector<std::string>> published;  ///< as the original printed it: heads, then rows; may be empty
};

struct PlotSpec {
  std::string id, title, kind = "line";  ///< line, bar or scatter
  FigureSpec figure;
  std::string x;                    ///< a factor; of a scatter plot perhaps arithmetic on metrics
  bool x_is_figure = false;         ///< x is arithmetic on metrics
  std::vector<std::string> series;  ///< factors
  std::vector<std::string> panels;  ///< factors: one small plot for each combination
  std::string x_title, y_title;
  bool log_x = false, log_y = false;
  /// Which end of x and of y is better; points that no other of their panel beats in both are then marked.
  enum class Better { low, high };
  std::optional<std::pair<Better, Better>> front;
};

/// What a claim expects of every cell.
struct Expectation {
  enum class Kind { above, below, between, differs, same, rises, falls, unrelated, splits } kind = Kind::above;
  double low = 0, high = 0;  ///< of above, below, between; of splits: limits of the figure and of what it is beside
  /// Of rises, falls, unrelated: a factor, "triangles", "baseline" (its figure), or "versus" (that figure).
  std::string along;
};

struct ClaimSpec {
  std::string id, text, published, note;
  FigureSpec figure;
  /// A second figure of the same cells: the first is divided by it, or ranked along it, or compared with it.
  std::optional<FigureSpec> versus;
  std::vector<std::string> each;      ///< factors that tell cells apart
  std::optional<Expectation> expect;  ///< none: nothing is measured, and the note says why
  std::string need = "all";           ///< "all", "any", "most", "mean" (of all cells), or a share such as "0.75"
};

struct Study {
  std::string name, title, source, text;
  std::string file_text;  ///< the file as it was
  RunSpec run;
  bool quick = false;
  std::vector<SceneSpec> scenes;
  std::vector<RecipeSpec> recipes;
  std::vector<TableSpec> tables;
  std::vector<PlotSpec> plots;
  std::vector<ClaimSpec> claims;
  std::vector<std::string> pictures;  ///< labels of recipes whose heat maps are drawn
};

}  // namespace boxwood
