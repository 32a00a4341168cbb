// Control: which directive does what, scopes, included files and objects.
#include "scene/importers/pbrt/reader.h"

#include <fmt/format.h>

namespace boxwood::pbrt {
namespace {

constexpr std::size_t deepest_scope = 10'000, deepest_include = 64, most_includes = 16'384;

bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

}  // namespace

Reader::Reader(const std::filesystem::path& file) : folder_(file.parent_path()) {
  now_.material.diffuse = {0.5f, 0.5f, 0.5f};
  imported_.files.push_back(file);
}

const std::map<std::string_view, Reader::Directive>& Reader::directives() {
  static const std::map<std::string_view, Directive> all = {
      {"Identity", &Reader::identity},
      {"Translate", &Reader::translate},
      {"Scale", &Reader::scale},
      {"Rotate", &Reader::rotate},
      {"LookAt", &Reader::look_at},
      {"Transform", &Reader::transform},
      {"ConcatTransform", &Reader::concat_transform},
      {"CoordinateSystem", &Reader::coordinate_system},
      {"CoordSysTransform", &Reader::coord_sys_transform},
      {"ActiveTransform", &Reader::active_transform},
      {"TransformTimes", &Reader::transform_times},
      {"AttributeBegin", &Reader::attribute_begin},
      {"AttributeEnd", &Reader::attribute_end},
      {"TransformBegin", &Reader::transform_begin},
      {"TransformEnd", &Reader::transform_end},
      {"ReverseOrientation", &Reader::reverse_orientation},
      {"WorldBegin", &Reader::world_begin},
      {"WorldEnd", &Reader::nothing},
      {"Include", &Reader::include},
      {"Import", &Reader::import},
      {"ObjectBegin", &Reader::object_begin},
      {"ObjectEnd", &Reader::object_end},
      {"ObjectInstance", &Reader::object_instance},
      {"Camera", &Reader::camera},
      {"Film", &Reader::film},
      {"LightSource", &Reader::light_source},
      {"AreaLightSource", &Reader::area_light_source},
      {"Material", &Reader::material},
      {"MakeNamedMaterial", &Reader::make_named_material},
      {"NamedMaterial", &Reader::named_material},
      {"Texture", &Reader::texture},
      {"Shape", &Reader::shape},
      {"MediumInterface", &Reader::media},
      {"MakeNamedMedium", &Reader::media},
      // How to render, which the caller says.
      {"Accelerator", &Reader::pass_over},
      {"ColorSpace", &Reader::pass_over},
      {"Filter", &Reader::pass_over},
      {"Integrator", &Reader::pass_over},
      {"Option", &Reader::pass_over},
      {"PixelFilter", &Reader::pass_over},
      {"Renderer", &Reader::pass_over},
      {"Sampler", &Reader::pass_over},
      {"SurfaceIntegrator", &Reader::pass_over},
      {"VolumeIntegrator", &Reader::pass_over},
  };
  return all;
}

Imported Reader::read() {
  read_file(imported_.files.front());
  if (!scopes_.empty()) {
    throw Error(
        fmt::format("{}: what begins here never ends; the file is incomplete, get it again", scopes_.back().place));
  }
  return finish();
}

void Reader::read_file(const std::filesystem::path& file) {
  Tokens tokens(file);
  Tokens* const outer = tokens_;
  tokens_ = &tokens;
  for (Token token = tokens.next(); token.kind != Token::Kind::end; token = tokens.next()) {
    if (token.kind != Token::Kind::word) tokens.fail_expected("a directive", token);
    execute(std::string(token.text));
  }
  tokens_ = outer;
}

void Reader::execute(const std::string& word) {
  const auto found = directives().find(word);
  if (found != directives().end()) return (this->*found->second)();
  if (!is_letter(word.front())) {
    tokens().fail(fmt::format("expected a directive, found '{}'; mend the line", word.substr(0, 40)));
  }
  notes_.add("directive " + word, [&] {
    return fmt::format("{}: the directive '{}' is not known here; it was skipped", tokens().place(),
                       word.substr(0, 40));
  });
  pass_over();
}

void Reader::nothing() {}

void Reader::pass_over() {
  const auto is_directive = [](const Token& token) {
    return token.kind == Token::Kind::word && is_letter(token.text.front()) && token.text != "true" &&
           token.text != "false";
  };
  while (tokens().peek().kind != Token::Kind::end && !is_directive(tokens().peek())) tokens().next();
}

void Reader::media() {
  notes_.add("media", [&] {
    return fmt::format("{}: media (fog, smoke, translucency) are not read; they were left out", tokens().place());
  });
  pass_over();
}

void Reader::open_scope(bool transform_only) {
  if (scopes_.size() == deepest_scope) {
    tokens().fail(fmt::format("scopes are nested more than {} deep; is an end missing?", deepest_scope));
  }
  scopes_.push_back({now_, transform_only, tokens().place()});
}

void Reader::close_scope(bool transform_only) {
  if (scopes_.empty() || scopes_.back().transform_only != transform_only) {
    tokens().fail(scopes_.empty() ? std::string("ends what never began; remove the line")
                                  : fmt::format("ends something else than what began at {}; mend one of them",
                                                scopes_.back().place));
  }
  if (transform_only) {
    now_.to_world = scopes_.back().attributes.to_world;
  } else {
    now_ = std::move(scopes_.back().attributes);
  }
  scopes_.pop_back();
}

void Reader::attribute_begin() { open_scope(false); }
void Reader::attribute_end() { close_scope(false); }
void Reader::transform_begin() { open_scope(true); }
void Reader::transform_end() { close_scope(true); }
void Reader::reverse_orientation() { now_.reverse = !now_.reverse; }

void Reader::world_begin() {
  now_.to_world = {};
  coordinate_systems_["world"] = {};
}

std::optional<std::filesystem::path> Reader::find_file(const std::string& name, const std::string& place) {
  const std::filesystem::path file = folder_ / name;
  std::error_code ignored;
  if (!name.empty() && std::filesystem::is_regular_file(file, ignored)) {
    if (imported_.files.empty() || imported_.files.back() != file) imported_.files.push_back(file);
    return file;
  }
  if (missing_.insert(file).second) {
    imported_.files.push_back(file);
    notes_.add("missing", [&] { return fmt::format("{}: the file '{}' is missing; it was left out", place, name); });
  }
  return std::nullopt;
}

void Reader::include() {
  const std::string place = tokens().place();
  const std::string name = tokens().text("a file name");
  const std::optional<std::filesystem::path> file = find_file(name, place);
  if (!file) return;
  const auto refuse = [&](std::size_t limit, const char* what) {
    throw Error(fmt::format("{}: {} {}; does a file include itself?", place, what, limit));
  };
  if (include_depth_ == deepest_include) refuse(deepest_include, "files include files deeper than");
  if (++includes_ > most_includes) refuse(most_includes, "files are included more often than");
  ++include_depth_;
  read_file(*file);
  --include_depth_;
}

void Reader::import() {
  open_scope(false);
  const std::size_t scopes = scopes_.size();
  include();
  if (scopes_.size() != scopes) tokens().fail("the imported file leaves something open, or closes too much; mend it");
  close_scope(false);
}

void Reader::object_begin() {
  if (assembly_.defining()) tokens().fail("an object begins inside an object; end that first");
  open_scope(false);
  assembly_.begin_object(tokens().text("an object's name"));
}

void Reader::object_end() {
  if (!assembly_.defining()) tokens().fail("ends an object where none began; remove the line");
  close_scope(false);
  assembly_.end_object();
}

void Reader::object_instance() {
  const std::string place = tokens().place();
  const std::string name = tokens().text("an object's name");
  if (assembly_.place_object(name, now_.to_world, place)) return;
  notes_.add("object", [&] { return fmt::format("{}: the object '{}' is not defined; it was left out", place, name); });
}

}  // namespace boxwood::pbrt

namespace boxwood {

Imported import_pbrt(const std::filesystem::path& file) { return pbrt::Reader(file).read(); }

}  // namespace boxwood
