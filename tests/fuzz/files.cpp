// Files of our own formats, and what users write: recipes and studies.
#include <cstring>
#include <vector>

#include "boxwood/ray_set.h"
#include "boxwood/recipe.h"
#include "boxwood/saved.h"
#include "boxwood/structure.h"
#include "fuzz/support.h"
#include "saved/section_file.h"
#include "study/study_file.h"
#include "support/rays.h"
#include "support/scenes.h"

namespace boxwood::fuzz {
namespace {

void trace_all(const Structure& structure, const std::vector<Ray>& rays) {
  std::vector<Hit> hits(rays.size());
  structure.closest_hits(rays, hits);
  for (const Ray& ray : rays) structure.any_hit(ray);
  structure.all_hits(rays.front());
}

/// A saved structure, section by section.
struct Saved {
  std::vector<SectionKind> kinds;
  std::vector<std::string> sections;
  std::vector<Ray> rays;
};

Saved take_apart(const Scene& scene, const char* recipe) {
  const std::filesystem::path file = scratch() / "whole.boxwood";
  save(build(scene, recipe, {.threads = 1}), file);
  Saved out;
  out.rays = test::troubling_rays(scene, 12, 1);
  SectionFile sections(file, true);
  for (std::size_t i = 0; !sections.at_end(); ++i) {
    out.kinds.push_back(static_cast<SectionKind>(i < 2 ? i + 1 : 3 + (i - 2) % 3));
    const auto bytes = sections.next(out.kinds.back());
    out.sections.emplace_back(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  return out;
}

const std::vector<Saved>& saved_structures() {
  static const std::vector<Saved> all = [] {
    std::vector<Saved> out;
    for (const char* recipe :
         {"median > binary", "binned > wide(4) > trace(simd=off)", "binned > wide(4)", "median(leaf=9) > wide(8)",
          "binned > wide(16)", "binned > collapse(8) > compressed(8)", "binned > collapse(16) > compressed(16)"}) {
      out.push_back(take_apart(test::soup(30, 0.5f, 1), recipe));
    }
    out.push_back(take_apart(test::instances(), "binned > wide(8)"));
    return out;
  }();
  return all;
}

}  // namespace

void read_ray_sets(Bytes bytes) {
  std::vector<std::uint8_t> whole(bytes.begin(), bytes.end());
  std::uint64_t sum = 0xcbf29ce484222325;  // FNV-1a, as docs/ray-sets.md says
  for (const std::uint8_t byte : bytes) sum = (sum ^ byte) * 0x100000001b3;
  for (int i = 0; i < 8; ++i) whole.push_back(static_cast<std::uint8_t>(sum >> 8 * i));
  accept_or_refuse([&] {
    const std::vector<RaySet> sets = load_ray_sets(write_file("input.rays", whole));
    save_ray_sets(scratch() / "again.rays", sets);
    require(load_ray_sets(scratch() / "again.rays").size() == sets.size(), "ray sets that do not read back");
  });
}

void read_saved_file(Bytes bytes) {
  const std::filesystem::path file = write_file("input.boxwood", bytes);
  accept_or_refuse([&] { load_structure(file); });
  accept_or_refuse([&] { load_structure(file, {.verification = Verification::header}); });
}

void read_patched_structure(Bytes bytes) {
  if (bytes.size() < 2) return;
  const Saved& saved = saved_structures()[bytes[0] % saved_structures().size()];
  std::vector<std::string> contents = saved.sections;
  std::string& patched = contents[bytes[1] % contents.size()];
  for (std::size_t at = 2; at + 4 <= bytes.size(); at += 4) {
    std::uint16_t where = 0, what = 0;
    std::memcpy(&where, &bytes[at], 2);
    std::memcpy(&what, &bytes[at + 2], 2);
    if (patched.size() >= 2) std::memcpy(patched.data() + where % (patched.size() - 1), &what, 2);
  }
  std::vector<Section> sections;
  for (std::size_t i = 0; i < contents.size(); ++i) {
    sections.push_back({saved.kinds[i], std::as_bytes(std::span(contents[i]))});
  }
  const std::filesystem::path file = scratch() / "patched.boxwood";
  write_sections(file, sections);
  accept_or_refuse([&] { trace_all(load_structure(file), saved.rays); });
}

void parse_a_recipe(Bytes bytes) {
  accept_or_refuse([&] {
    const Recipe recipe = Recipe::parse(text_of(bytes));
    require(Recipe::parse(recipe.text()).text() == recipe.text(), "a recipe that does not read back");
  });
}

void parse_a_study(Bytes bytes) {
  for (const bool quick : {false, true}) {
    accept_or_refuse([&] { parse_study(text_of(bytes), "input.toml", quick); });
  }
}

}  // namespace boxwood::fuzz
