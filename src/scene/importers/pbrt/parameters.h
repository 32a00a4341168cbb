#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "boxwood/vec3.h"
#include "scene/importers/pbrt/tokens.h"

namespace boxwood::pbrt {

/// One "TYPE NAME" [ VALUES ] of a directive. Which of the three lists holds the values follows from the type.
struct Parameter {
  std::string type, name;
  std::vector<float> numbers;
  std::vector<std::int32_t> integers;
  std::vector<std::string> texts;  ///< texts, names of textures and spectra, "true" and "false"
};

/// The parameter list of a directive. Values of a wrong type or number are errors that name the place of the directive.
class Parameters {
 public:
  /// Reads up to the next directive. Throws Error with file and line.
  explicit Parameters(Tokens& tokens);

  /// Null when it is not given.
  const Parameter* find(std::string_view name) const;
  bool has(std::string_view name) const { return find(name) != nullptr; }
  float number(std::string_view name, float otherwise) const;
  std::int32_t integer(std::string_view name, std::int32_t otherwise) const;
  std::string text(std::string_view name, std::string_view otherwise) const;
  bool flag(std::string_view name, bool otherwise) const;
  Vec3 point(std::string_view name, const Vec3& otherwise) const;
  /// All points, vectors or normals of a list; empty when it is not given.
  std::vector<Vec3> points(std::string_view name) const;

  /// Where the directive stands.
  const std::string& place() const { return place_; }
  [[noreturn]] void fail(std::string_view what) const;

 private:
  const float& first_number(const Parameter& parameter) const;
  std::string place_;
  std::vector<Parameter> list_;
};

}  // namespace boxwood::pbrt
