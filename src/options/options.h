#pragma once
#include <any>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "boxwood/error.h"

namespace boxwood {

/// One option of a stage, described once: parsing, help, defaults and canonical printing all come from here.
struct Option {
  std::string name;
  std::string help;
  std::string values;       ///< what it takes: "2…16", "longest | all", …
  bool positional = false;  ///< may be given without its name, as 4 in wide(4)
  std::function<void(std::any& options, std::string_view text)> set;  ///< throws UsageError("takes …, not '…'")
  std::function<std::string(const std::any& options)> get;
};

/// Describes the options struct `T` of a stage, member by member.
///   OptionsOf<Median>().integer("k", &Median::k, 2, 16, "children per node").choice("axis", &Median::axis, {…}, "…")
template <class T>
class OptionsOf {
 public:
  OptionsOf& integer(std::string name, std::uint32_t T::*member, std::uint32_t low, std::uint32_t high,
                     std::string help);
  OptionsOf& real(std::string name, float T::*member, float low, float high, std::string help);
  OptionsOf& flag(std::string name, bool T::*member, std::string help);  ///< on | off
  /// `names[i]` stands for the enumerator with value i.
  template <class E>
  OptionsOf& choice(std::string name, E T::*member, std::vector<std::string> names, std::string help);
  /// Anything that `parse` makes of a text (or throws UsageError("takes …, not '…'")) and `print` turns back into it.
  template <class V>
  OptionsOf& value(std::string name, V T::*member, V (*parse)(std::string_view), std::string (*print)(const V&),
                   std::string values, std::string help);
  /// The option described last may be given without its name.
  OptionsOf& positional();

  std::vector<Option> take() { return std::move(options_); }

 private:
  OptionsOf& add(Option option);
  std::vector<Option> options_;
};

namespace option_text {
std::uint32_t parse_integer(std::string_view text, std::uint32_t low, std::uint32_t high);
float parse_real(std::string_view text, float low, float high);
bool parse_flag(std::string_view text);
std::size_t parse_choice(std::string_view text, std::span<const std::string> names);
std::string print_real(float value);
std::string join(std::span<const std::string> names, std::string_view separator);
}  // namespace option_text

template <class T>
OptionsOf<T>& OptionsOf<T>::add(Option option) {
  options_.push_back(std::move(option));
  return *this;
}

template <class T>
OptionsOf<T>& OptionsOf<T>::positional() {
  options_.back().positional = true;
  return *this;
}

template <class T>
OptionsOf<T>& OptionsOf<T>::integer(std::string name, std::uint32_t T::*member, std::uint32_t low, std::uint32_t high,
                                    std::string help) {
  return add({std::move(name), std::move(help), std::to_string(low) + "…" + std::to_string(high), false,
              [=](std::any& options, std::string_view text) {
                std::any_cast<T&>(options).*member = option_text::parse_integer(text, low, high);
              },
              [=](const std::any& options) { return std::to_string(std::any_cast<const T&>(options).*member); }});
}

template <class T>
OptionsOf<T>& OptionsOf<T>::real(std::string name, float T::*member, float low, float high, std::string help) {
  return add(
      {std::move(name), std::move(help), option_text::print_real(low) + "…" + option_text::print_real(high), false,
       [=](std::any& options, std::string_view text) {
         std::any_cast<T&>(options).*member = option_text::parse_real(text, low, high);
       },
       [=](const std::any& options) { return option_text::print_real(std::any_cast<const T&>(options).*member); }});
}

template <class T>
OptionsOf<T>& OptionsOf<T>::flag(std::string name, bool T::*member, std::string help) {
  return add(
      {std::move(name), std::move(help), "on | off", false,
       [=](std::any& options, std::string_view text) {
         std::any_cast<T&>(options).*member = option_text::parse_flag(text);
       },
       [=](const std::any& options) { return std::string(std::any_cast<const T&>(options).*member ? "on" : "off"); }});
}

template <class T>
template <class E>
OptionsOf<T>& OptionsOf<T>::choice(std::string name, E T::*member, std::vector<std::string> names, std::string help) {
  std::string values = option_text::join(names, " | ");
  return add({std::move(name), std::move(help), std::move(values), false,
              [=](std::any& options, std::string_view text) {
                std::any_cast<T&>(options).*member = static_cast<E>(option_text::parse_choice(text, names));
              },
              [=](const std::any& options) {
                return names[static_cast<std::size_t>(std::any_cast<const T&>(options).*member)];
              }});
}

template <class T>
template <class V>
OptionsOf<T>& OptionsOf<T>::value(std::string name, V T::*member, V (*parse)(std::string_view),
                                  std::string (*print)(const V&), std::string values, std::string help) {
  return add({std::move(name), std::move(help), std::move(values), false,
              [=](std::any& options, std::string_view text) { std::any_cast<T&>(options).*member = parse(text); },
              [=](const std::any& options) { return print(std::any_cast<const T&>(options).*member); }});
}

}  // namespace boxwood
