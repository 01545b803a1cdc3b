#include "harness/plugin/plugins.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <vector>

#include <pairsum/core/error.hpp>
#include <pairsum/plugin.hpp>
#include <pairsum/sum/registry.hpp>
#include "harness/rows/fields.hpp"
#include "harness/rows/hash_text.hpp"

namespace pairsum::harness {
namespace {

constexpr const char* variable = "PAIRSUM_PLUGINS";
constexpr char separator = ':';

std::string named_plugins() {
  const char* const named = std::getenv(variable);
  return named == nullptr ? "" : named;
}

void name_plugin(const std::string& file) {
  if (file.empty()) throw error("--plugin takes the name of a file, not \"\"");
  const std::string path = std::filesystem::absolute(file).string(), named = named_plugins();
  if (path.find(separator) != path.npos) throw error(fmt::format("plug-in {}: its path has a colon", path));
  ::setenv(variable, (named.empty() ? path : named + separator + path).c_str(), 1);
}

std::map<std::string, std::string>& loaded() {
  static std::map<std::string, std::string> by_name;
  return by_name;
}

std::string content_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Its words are printed, and stand in rows.
void check_texts(const std::string& file, const std::string& name) {
  std::vector<std::string> texts{name};
  for (const backend_entry& b : registry::instance().backends())
    for (const std::string_view text : {b.traits.name, b.traits.description, b.traits.aliases})
      texts.emplace_back(text);
  for (const auto& word : registry::instance().interactions()) texts.emplace_back(word);
  if (std::ranges::any_of(texts, has_controls))
    throw error(fmt::format("plug-in {}: a name or description in it has control characters", file));
}

/// Never closed: the registry points into it.
void load_plugin(const std::string& file) {
  if (has_controls(file)) throw error(fmt::format("plug-in {}: its path has control characters", file));
  static std::vector<void*> opened;
  void* const object = ::dlopen(std::filesystem::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (object == nullptr) throw error(fmt::format("cannot open plug-in {}", ::dlerror()));  // which names the file
  if (std::ranges::find(opened, object) != opened.end()) return;
  opened.push_back(object);
  const auto* const offered = static_cast<const plugin*>(::dlsym(object, "pairsum_plugin"));
  if (offered == nullptr)
    throw error(fmt::format("{} is no plug-in: it has no symbol pairsum_plugin, which PAIRSUM_PLUGIN makes", file));
  if (offered->build != std::string_view(build_word))
    throw error(
        fmt::format("plug-in {} is of build \"{}\" and this program of \"{}\": rebuild the plug-in against "
                    "the package that this program was installed with",
                    file, offered->build, build_word));
  const std::string what =
      fmt::format("{} {}", std::filesystem::path(file).filename().string(), hash_text(content_of(file)));
  if (!loaded().emplace(offered->name, what).second)
    throw error(fmt::format("plug-in {}: there is a plug-in {} already", file, offered->name));
  try {
    offered->add(registry::changeable_instance());
  } catch (const std::exception& e) {
    throw error(fmt::format("plug-in {}: {}", file, e.what()));
  }
  check_texts(file, offered->name);
}

}  // namespace

void add_plugin_option(CLI::App& command) {
  command
      .add_option_function<std::vector<std::string>>(
          "--plugin", [](const std::vector<std::string>& files) { std::ranges::for_each(files, name_plugin); },
          "shared object with backends or interactions of your own; may be given several times")
      ->allow_extra_args(false);
}

void load_named_plugins() {
  std::istringstream named(named_plugins());
  for (std::string file; std::getline(named, file, separator);)
    if (!file.empty()) load_plugin(file);
}

const std::map<std::string, std::string>& loaded_plugins() { return loaded(); }

}  // namespace pairsum::harness
