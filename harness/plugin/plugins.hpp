#pragma once
#include <map>
#include <string>

namespace CLI {
class App;
}

namespace pairsum::harness {

/// Option --plugin FILE, which may be given several times: names a plug-in (kernels/plugin.hpp) to this process and to
/// those that it starts, in the environment variable PAIRSUM_PLUGINS.
void add_plugin_option(CLI::App& command);

/// Adds to the registry what the plug-ins in PAIRSUM_PLUGINS offer, each once; before anything reads the registry.
/// Throws pairsum::error for a file that is no plug-in, or one of another build, and for words that are taken.
void load_named_plugins();

/// The plug-ins that are loaded, by name: file name and 16 digits that stand for the content.
const std::map<std::string, std::string>& loaded_plugins();

}  // namespace pairsum::harness
