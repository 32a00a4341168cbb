// The only file that knows toml11, which takes long to compile.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <sstream>
#include <toml.hpp>

#include "study/toml.h"

namespace boxwood {
namespace {

using Source = toml::basic_value<toml::discard_comments, std::map, std::vector>;

/// toml11 keeps tables sorted by name; the file's order is that of the places.
TomlValue convert(const Source& source, const std::string& path, const std::string* file) {
  TomlValue out;
  out.path = path;
  out.line = static_cast<std::uint32_t>(source.location().line());
  out.file = file;
  switch (source.type()) {
    case toml::value_t::boolean:
      out.data = source.as_boolean();
      break;
    case toml::value_t::integer:
      out.data = std::int64_t{source.as_integer()};
      break;
    case toml::value_t::floating:
      out.data = source.as_floating();
      break;
    case toml::value_t::string:
      out.data = source.as_string().str;
      break;
    case toml::value_t::array: {
      TomlValue::List list;
      for (const Source& item : source.as_array()) list.push_back(convert(item, path, file));
      out.data = std::move(list);
      break;
    }
    case toml::value_t::table: {
      TomlValue::Table table;
      for (const auto& [key, item] : source.as_table()) {
        table.push_back({key, convert(item, path.empty() ? key : fmt::format("{}.{}", path, key), file)});
      }
      std::ranges::stable_sort(table, {}, [](const auto& entry) { return entry.second.line; });
      out.data = std::move(table);
      break;
    }
    default:
      out.fail("is a date or time, which means nothing here");
  }
  return out;
}

}  // namespace

std::unique_ptr<const TomlFile> parse_toml(std::string_view text, const std::string& file_name) {
  auto file = std::make_unique<TomlFile>();
  file->name = file_name;
  try {
    std::istringstream stream{std::string(text)};
    file->root =
        convert(toml::parse<toml::discard_comments, std::map, std::vector>(stream, file_name), "", &file->name);
  } catch (const toml::exception& error) {
    std::string what = error.what();
    // toml11 draws a picture of the place; one sentence is our way.
    what = what.substr(0, what.find('\n'));
    if (what.starts_with("[error] ")) what = what.substr(8);
    throw UsageError(file_name + ":" + std::to_string(error.location().line()) + ": this is no TOML: " + what);
  } catch (const std::logic_error& error) {
    throw UsageError(file_name + ": this is no TOML: " + error.what());
  }
  return file;
}

}  // namespace boxwood
